// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "format/text_layout.hpp"
#include "job/machine/files/machine_job_files.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_lines = 8;

}  // namespace

std::string harm_text(const ProgramHarm& harm) {
  std::string text = fmt::format("on {} ({} positions)\n", harm.file, harm.blocks);
  std::size_t hidden = 0;
  for (const EffectOnProgram& one : harm.effects) {
    if (!one.found && ++hidden > most_lines) continue;
    text += fmt::format(
        "  {:<14} {:>9} at line {}{}\n", one.effect, layout::um(one.tip.value), one.tip.line,
        one.found ? ""
                  : fmt::format(", if {} of it hide",
                                one.unit == "rad" ? fmt::format("{:.3g} µrad", 1e6 * one.size)
                                                  : layout::um(one.size)));
  }
  if (hidden > most_lines)
    text += fmt::format("  and {} more that could hide and do less\n", hidden - most_lines);
  text += fmt::format("  U of the tip {} at line {} (k = {:.3g})", layout::um(harm.U.value),
                      harm.U.line, harm.coverage_factor);
  for (const PlanOnProgram& one : harm.plans)
    text += fmt::format("{}{} {}", &one == &harm.plans.front() ? "; after " : ", ", one.plan,
                        layout::um(one.U.value));
  return text + "\n";
}

std::string harm_screen(const ProgramHarm& harm) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, harm.effects.size()); ++i) {
    const EffectOnProgram& one = harm.effects[i];
    if (!(one.tip.value > 0.0)) break;
    text += fmt::format("{}{} {}{}", i == 0 ? "" : ", ", one.effect, layout::um(one.tip.value),
                        one.found ? "" : " if it hides");
  }
  if (!text.empty()) text = "part   on " + harm.file + " the tip is off by " + text + "\n";
  text += fmt::format("U      of the tip {} (k = {:.3g}), without the place of the part",
                      layout::um(harm.U.value), harm.coverage_factor);
  for (const PlanOnProgram& one : harm.plans)
    text += fmt::format("{}{} {}", &one == &harm.plans.front() ? "; after " : ", ", one.plan,
                        layout::um(one.U.value));
  return text + "\n";
}

}  // namespace trueaxis
