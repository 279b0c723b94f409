// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "compensate/files/compensation_files.hpp"
#include "format/reason_words.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using layout::um;

std::string axis_changes(const ProgramCompensation& result) {
  std::string text;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const LargestInProgram& one = result.largest_change[k];
    if (one.line == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(1, "XYZABC"[k]) + ' ';
    text += is_rotary(static_cast<AxisName>(k)) ? fmt::format("{:.3g}°", one.value / rad_per_deg)
                                                : um(one.value);
  }
  return text;
}

}  // namespace

std::string changes_screen(const ProgramCompensation& result) {
  std::string text =
      fmt::format("blocks {} read, {} move, {} rewritten, {} inserted", result.blocks_read,
                  result.blocks_moved, result.blocks_rewritten, result.blocks_inserted);
  const std::string changes = axis_changes(result);
  return text + (changes.empty() ? "\n" : "; changed by up to " + changes + "\n");
}

namespace {

std::string causes_screen(const ProgramCompensation& result) {
  std::string alone;
  for (std::size_t i = 0; i < std::min<std::size_t>(5, result.by_error.size()); ++i)
    alone +=
        (i == 0 ? "" : ", ") + result.by_error[i].name + ' ' + um(result.by_error[i].tip.value);
  return alone.empty() ? "" : "cause  the tip off by each error alone: " + alone + "\n";
}

/// "0.118°"; in words if no axis resolves it.
std::string degrees(double angle_rad) {
  const double deg = angle_rad / rad_per_deg;
  return deg < 1e-4 ? "less than 0.0001°" : significant(deg, 2) + "°";
}

/// Blocks near a pole.
std::string blocks_screen(const ProgramCompensation& result) {
  std::string text;
  if (!result.singular.empty())
    text += fmt::format("pole   {} whose direction is not corrected, the first in line {}\n",
                        counted(result.singular.size(), "block"), result.singular.front().line);
  return text;
}

std::string next_screen_of(const ProgramCompensation& result, const CompensationOptions& options) {
  const double between_mm = result.between_after.value;
  if (options.tolerance_mm && between_mm > *options.tolerance_mm)
    return "next   a smaller --tolerance-um than " + um(*options.tolerance_mm) +
           ": between the ends of blocks the tip is off by " + um(between_mm) + "\n";
  if (!options.tolerance_mm && between_mm > std::max(1e-3, 5.0 * result.after.position.value))
    return "next   --tolerance-um splits the moves: between their ends the tip is off by " +
           um(between_mm) + "\n";
  return "next   Run the new program instead of the old one; trueaxis machine simulate tests it "
         "first\n";
}

}  // namespace

std::string compensation_screen(const ProgramCompensation& result,
                                const CompensationOptions& options) {
  if (result.blocks_moved == 0) return "DONE: the program does not move; nothing was changed\n";
  const LargestInProgram before = result.off_before(), after = result.off_after();
  const bool all_counted = std::ranges::all_of(result.reservations, [](const Reason& one) {
    return one.code == ReasonCode::direction_worse;
  });
  std::string text =
      fmt::format("DONE: tip off by {} at most {} with the new program, {} without it (line {})",
                  um(after.value), all_counted ? "on the whole path" : "where its path is known",
                  um(before.value), before.line);
  for (const Reason& one : result.reservations) text += "; " + words_of(one);
  text += "\n" + next_screen_of(result, options);
  text += "ends   off by " + um(result.after.position.value) + " at the ends of blocks, " +
          um(result.before.position.value) + " without it\n";
  text += "path   off by " + um(result.between_after.value) + " between the ends of blocks, " +
          um(result.between_before.value) + " without it\n";
  text += "turned direction of the tool off by " + degrees(result.after.direction.value) + ", " +
          degrees(result.before.direction.value) + " without it\n";
  if (result.u_tip)
    text += fmt::format(
        "U      of the tip {} (k = {:g}), the uncertainty of the part's place included\n",
        um(options.coverage_factor * result.u_tip->value), options.coverage_factor);
  return text + changes_screen(result) + causes_screen(result) + blocks_screen(result);
}

}  // namespace trueaxis
