// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "format/file.hpp"
#include "format/json.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"

namespace trueaxis {
namespace {

using virtual_machine::Cut;
using virtual_machine::CutRow;
using virtual_machine::LargestOff;

std::string said(const LargestOff& largest, const char* unit, double of_unit) {
  if (largest.line == 0) return fmt::format("0 {}", unit);
  return fmt::format("{:.3g} {} (line {})", largest.value / of_unit, unit, largest.line);
}

}  // namespace

std::string cut_csv(const Cut& cut) {
  std::string text =
      "# schema: trueaxis.path/1\n"
      "line,end,t[s],x[mm],y[mm],z[mm],i,j,k,off[um],angle[deg]\n";
  const auto out = std::back_inserter(text);
  for (const CutRow& row : cut.rows) {
    fmt::format_to(out, "{},{},{:.9g}", row.line, row.end ? 1 : 0, row.time_s);
    for (const Vector3& three : {row.tool.tip_mm, row.tool.direction})
      for (const double one : three) fmt::format_to(out, ",{:.17g}", one);
    text += ',';
    if (std::isfinite(row.off_mm)) fmt::format_to(out, "{:.9g}", row.off_mm / mm_per_um);
    text += ',';
    if (std::isfinite(row.angle_rad)) fmt::format_to(out, "{:.9g}", row.angle_rad / rad_per_deg);
    text += '\n';
  }
  return text;
}

std::string cut_json(const Cut& cut, const CutScenario& scenario) {
  const auto input = [](const std::string& path) -> Json {
    return {{"file", path}, {"hash", content_hash(read_file(path))}};
  };
  Json json{{"schema", "trueaxis.cut/1"},
            {"version", TRUEAXIS_VERSION},
            {"inputs", list_of(scenario.of.read, input)},
            {"program", scenario.plan.program_file},
            {"nominal", scenario.plan.nominal_file},
            {"moves", cut.blocks},
            {"block_ends", cut.judged_ends},
            {"time", with_unit(cut.time_s, "s")}};
  const auto off = [](const LargestOff& one) { return at_line(mm_json(one.value), one.line); };
  const LargestOff& angle = cut.angle_at_ends;
  json["off_at_ends"] = {{"position", off(cut.off_at_ends)},
                         {"direction", at_line(deg_json(angle.value), angle.line)}};
  json["off_between"] = off(cut.off_between);
  return json_text(json);
}

std::string cut_text(const Cut& cut, const CutScenario& scenario) {
  std::string text = fmt::format("{}: {} moves, {} block ends of {}\n", scenario.plan.program_file,
                                 cut.blocks, cut.judged_ends, scenario.plan.nominal_file);
  text += fmt::format("  at block ends   {}, {}\n", said(cut.off_at_ends, "µm", mm_per_um),
                      said(cut.angle_at_ends, "deg", rad_per_deg));
  text += fmt::format("  between blocks  {}\n", said(cut.off_between, "µm", mm_per_um));
  return text;
}

}  // namespace trueaxis
