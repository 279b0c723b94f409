// SPDX-License-Identifier: Apache-2.0
#include "resimulate/files/comparison.hpp"

#include <fmt/format.h>

#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

Json discrepancy(const Discrepancy& d) {
  return {{"rms", with_unit(d.rms_mm, "mm")}, {"share_of_variance", number(d.share)}};
}

std::string row(const char* name, const Discrepancy& d) {
  return fmt::format("  {:<27} {:12.3f} µm {:15.2f} %\n", name, d.rms_mm / mm_per_um,
                     100.0 * d.share);
}

}  // namespace

Json comparison_object(const Comparison& comparison) {
  const auto line = [](const SpectrumBin& one) -> Json {
    return {{"order", number(one.order)},
            {"before", mm_json(one.before_mm)},
            {"after", mm_json(one.after_mm)}};
  };
  return {{"readings", comparison.readings},
          {"masked", comparison.masked},
          {"before", discrepancy(comparison.before)},
          {"after", discrepancy(comparison.after)},
          {"noise", discrepancy(comparison.noise)},
          {"j_test_lambda", to_json(comparison.j_test_lambda)},
          {"lines", list_of(comparison.lines, line)}};
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

std::string resimulation_line(const Resimulation& again) {
  if (!again.why_not.empty()) return layout::wrapped("simulated   ", "not again: " + again.why_not);
  const Comparison& c = again.comparison;
  const std::string alone = c.noise.share < 1.0
                                ? fmt::format("noise alone leaves {:.3g} %", 100.0 * c.noise.share)
                                : "noise alone could make all of it";
  return layout::wrapped(
      "simulated   ",
      fmt::format("measured − simulated {:.3g} → {:.3g} µm RMS; {:.3g} % of the variance remains, ",
                  c.before.rms_mm / mm_per_um, c.after.rms_mm / mm_per_um, 100.0 * c.after.share) +
          alone);
}

std::string comparison_text(const Comparison& comparison) {
  std::string text = fmt::format("measured against simulated, {} readings", comparison.readings);
  if (comparison.masked > 0) text += fmt::format(" ({} excluded)", comparison.masked);
  text += "\n  measured − simulated          RMS              share of variance\n";
  text += row("before (ideal fit)", comparison.before);
  text += row("after (final fit)", comparison.after);
  text += row("noise alone", comparison.noise);
  if (comparison.lines.empty()) return text;
  text += "  largest lines, order          before           after\n";
  for (const SpectrumBin& line : comparison.lines) {
    text += fmt::format("  {:<27.3f} {:12.3f} µm {:12.3f} µm\n", line.order,
                        line.before_mm / mm_per_um, line.after_mm / mm_per_um);
  }
  return text;
}

}  // namespace trueaxis
