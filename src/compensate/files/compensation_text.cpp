// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "compensate/files/compensation_files.hpp"
#include "format/reason_words.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using fmt::format;

constexpr std::size_t most_shown = 10;

std::string in_line(const LargestInProgram& largest) {
  return largest.line == 0 ? "" : format(" (line {})", largest.line);
}
std::string length(const LargestInProgram& largest) {
  return layout::um(largest.value) + in_line(largest);
}
std::string angle(const LargestInProgram& largest) {
  return format("{:.3g} deg", largest.value / rad_per_deg) + in_line(largest);
}
std::string row(const std::string& name, const std::string& text) {
  return "  " + layout::padded(name, 16) + text + '\n';
}

std::string changes(const ProgramCompensation& result) {
  std::string text;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const LargestInProgram& one = result.largest_change[k];
    if (one.line == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(1, "XYZABC"[k]) + ' ';
    text += is_rotary(static_cast<AxisName>(k)) ? angle(one) : length(one);
  }
  return text;
}

std::string largest_errors(const ProgramCompensation& result) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(5, result.by_error.size()); ++i) {
    const ErrorAlone& one = result.by_error[i];
    text += (i == 0 ? "" : ", ") + one.name + ' ' + layout::um(one.tip.value);
  }
  return text;
}

}  // namespace

std::string compensation_text(const ProgramCompensation& result,
                              const CompensationOptions& options) {
  std::string text =
      format("{} blocks read, {} move, {} rewritten, {} inserted\n", result.blocks_read,
             result.blocks_moved, result.blocks_rewritten, result.blocks_inserted);
  if (result.blocks_moved == 0) return text;
  text += row("tip off by", length(result.off_before()) + ", now " + length(result.off_after()));
  for (const Reason& one : result.reservations) text += row("but", words_of(one));
  text += row("ends of blocks",
              length(result.before.position) + ", now " + length(result.after.position));
  text +=
      row("direction", angle(result.before.direction) + ", now " + angle(result.after.direction));
  text += row("between blocks",
              length(result.between_before) + ", now " + length(result.between_after));
  text += row("largest change", changes(result));
  if (!result.by_error.empty()) text += row("errors alone", largest_errors(result));
  if (result.u_tip)
    text += row(
        "U of the tip",
        format("{} (k = {:g}), including the uncertainty of the place of the part",
               layout::um(options.coverage_factor * result.u_tip->value), options.coverage_factor));
  if (!result.singular.empty())
    text +=
        row("at a pole", format("{} blocks, whose direction is not corrected: the first in line {}",
                                result.singular.size(), result.singular.front().line));
  return text;
}

std::string worse_text(const ProgramCompensation& result, const CompensationOptions& options) {
  const LargestInProgram before = result.off_before(), after = result.off_after();
  const std::string cure = options.tolerance_mm ? "Use a smaller --tolerance-um, or more decimals"
                                                : "Split its blocks (--tolerance-um)";
  if (!result.worse.empty())
    return format(
        "{} blocks would be further from their lines than before, the first in line {}: TrueAxis "
        "has not written the program. {}",
        result.worse.size(), result.worse.front(), cure);
  return format(
      "the new program would be off by {} in line {}, the old one by {}: TrueAxis has not written "
      "the program. {}",
      layout::um(after.value), after.line, layout::um(before.value), cure);
}

std::string unreachable_text(const ProgramCompensation& result, const std::string& file) {
  std::string text =
      format("{} of its blocks cannot be reached; nothing was written", result.unreachable.size());
  for (std::size_t i = 0; i < std::min(most_shown, result.unreachable.size()); ++i)
    text += format("\n{}:{}: {}", file, result.unreachable[i].line, result.unreachable[i].why);
  if (result.unreachable.size() > most_shown)
    text += format("\n… and {} more (--json has all)", result.unreachable.size() - most_shown);
  return text;
}

}  // namespace trueaxis
