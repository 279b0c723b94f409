// SPDX-License-Identifier: Apache-2.0
#include "resimulate/files/comparison_json.hpp"

namespace trueaxis {
namespace {

Json discrepancy(const Discrepancy& d) {
  return {{"rms", with_unit(d.rms_mm, "mm")}, {"share_of_variance", number(d.share)}};
}

}  // namespace

Json comparison_object(const Comparison& comparison) {
  Json lines = Json::array();
  for (const SpectrumBin& line : comparison.lines) {
    lines.push_back({{"order", number(line.order)},
                     {"before", with_unit(line.before_mm, "mm")},
                     {"after", with_unit(line.after_mm, "mm")}});
  }
  return {{"readings", comparison.readings},
          {"masked", comparison.masked},
          {"before", discrepancy(comparison.before)},
          {"after", discrepancy(comparison.after)},
          {"noise", discrepancy(comparison.noise)},
          {"j_test_lambda", to_json(comparison.j_test_lambda)},
          {"lines", lines}};
}

std::string comparison_json(const Comparison& comparison, const std::string& diagnosis,
                            const ProbeStream& stream) {
  Json json{{"schema", "trueaxis.comparison/2"},
            {"version", TRUEAXIS_VERSION},
            {"diagnosis", diagnosis},
            {"input", {{"file", stream.source}, {"hash", stream.input_hash}}}};
  json.update(comparison_object(comparison));
  return json_text(json);
}

}  // namespace trueaxis
