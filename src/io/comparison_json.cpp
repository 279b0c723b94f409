// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/io/comparison_json.hpp"

#include "io/json.hpp"

namespace trueaxis {
namespace {

Json discrepancy(const Discrepancy& d) {
  return {{"rms", with_unit(d.rms_mm, "mm")}, {"share_of_variance", number(d.share)}};
}

}  // namespace

std::string comparison_json(const Comparison& comparison, const std::string& diagnosis,
                            const ProbeStream& stream) {
  Json lines = Json::array();
  for (const ComparedLine& line : comparison.lines) {
    lines.push_back({{"order", number(line.order)},
                     {"before", with_unit(line.before_mm, "mm")},
                     {"after", with_unit(line.after_mm, "mm")}});
  }
  const Json json{{"schema", "trueaxis.comparison/1"},
                  {"version", TRUEAXIS_VERSION},
                  {"diagnosis", diagnosis},
                  {"input", {{"file", stream.source}, {"hash", stream.input_hash}}},
                  {"readings", comparison.readings},
                  {"masked", comparison.masked},
                  {"before", discrepancy(comparison.before)},
                  {"after", discrepancy(comparison.after)},
                  {"noise", discrepancy(comparison.noise)},
                  {"lines", lines}};
  return json_text(json);
}

}  // namespace trueaxis
