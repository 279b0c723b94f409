// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "format/text_layout.hpp"
#include "study/planning/files/planning_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using namespace study;
using fmt::format;
using layout::padded;

/// Three digits or four, and no exponent for what is large.
std::string digits(int count, double value) {
  return std::abs(value) < std::pow(10.0, count) ? format("{:.{}g}", value, count)
                                                 : format("{:.0f}", value);
}

std::string um(double length_mm) {
  return std::isfinite(length_mm) ? digits(3, length_mm / mm_per_um) : "not determined";
}

std::string u_text(double length_mm) {
  return "U is " + um(length_mm) + (std::isfinite(length_mm) ? " µm" : "");
}

std::string value_text(const PlannedMeasurement& plan, Choice choice) {
  const double value = plan.of(choice);
  if (choice == Choice::readings_per_revolution) return digits(4, value);
  if (choice == Choice::sigma) return digits(3, value / mm_per_um) + " µm";
  return digits(3, value) + (choice == Choice::feed ? " mm/rev" : " mm");
}

const char* const table_head =
    "length    feed         per rev  sigma     readings  time      readings/s  U [µm]\n";

std::string row_text(const PlannedMeasurement& plan) {
  return format("{:<10}{:<13}{:<9}{:<10}{:<10}{:<10}{:<12}{}", value_text(plan, Choice::length),
                value_text(plan, Choice::feed), value_text(plan, Choice::readings_per_revolution),
                value_text(plan, Choice::sigma), plan.readings, digits(4, plan.time_s) + " s",
                digits(4, plan.rate_hz), um(plan.u_expanded_mm));
}

std::string beyond_text(const PlanningTask& task, const PlannedMeasurement& plan) {
  constexpr double rounding = 1.0 + 1e-9;
  if (task.time_s && plan.time_s > *task.time_s * rounding) return "  takes too long";
  if (task.rate_hz && plan.rate_hz > *task.rate_hz * rounding) return "  too fast for the probe";
  return "";
}

std::string alone_text(const PlanningTask& task, const PlanningAnswer& answer) {
  std::string text = "\nOne thing changed, the others as they are\n";
  for (const Alone& one : answer.alone) {
    text += "  " + padded(info_of(one.choice).words, 26);
    text += one.reached ? value_text(one.plan, one.choice)
                        : "not in its range: at " + value_text(one.plan, one.choice) + ' ' +
                              u_text(one.plan.u_expanded_mm);
    if (one.reached) text += " (" + digits(4, one.plan.time_s) + " s)";
    text += beyond_text(task, one.plan) + '\n';
  }
  return text;
}

std::string confirmed_text(const Confirmation& confirmed, double goal_mm) {
  if (confirmed.repeats == 0) return "    simulated: no fit ended\n";
  std::string text =
      format("    simulated {} times: U {} µm (95 %: {} to {}), the fits state {} µm; ",
             confirmed.repeats, um(confirmed.u_expanded_mm), um(confirmed.interval_95_mm.low),
             um(confirmed.interval_95_mm.high), um(confirmed.stated_mm));
  text += confirmed.misses ? "misses the goal: the fit is not at the bound"
          : confirmed.interval_95_mm.high <= goal_mm ? "within the goal"
          : confirmed.interval_95_mm.low > goal_mm   ? "above the goal"
                                                     : "at the goal";
  const bool above = confirmed.interval_95_mm.low > goal_mm;
  if (confirmed.at_bound)
    text += above ? ", but the difference from the bound is within random scatter"
                  : ", as the bound says";
  if (confirmed.failures > 0) text += format(", {} failed", confirmed.failures);
  if (confirmed.states_more)
    text += format(
        "\n    the U that the fits state is {} times the goal: they treat as noise what the bound "
        "treats as known, such as effects and correlation",
        digits(3, confirmed.stated_mm / goal_mm));
  return text + '\n';
}

std::string not_reached_text(const PlanningTask& task, const PlanningAnswer& answer) {
  const PlannedMeasurement& plan = answer.nearest;
  const std::string beyond = beyond_text(task, plan);
  std::string text = "\nNot reached: ";
  if (!beyond.empty()) {
    text += "no plan of the ranges is within the time and the rate; the nearest";
  } else if (task.variables.empty()) {
    text += "as it is, " + u_text(plan.u_expanded_mm);
  } else {
    text += std::string("with the best that the ranges") + (task.time_s ? " and the time" : "") +
            " allow, " + u_text(plan.u_expanded_mm);
  }
  if (beyond.empty() && std::isfinite(plan.u_expanded_mm))
    text += ", " + digits(3, plan.u_expanded_mm / task.goal_mm) + " times the goal";
  if (task.variables.empty()) text += "; choose what may vary with --free";
  return text + "\n  " + table_head + "  " + row_text(plan) + beyond + '\n';
}

/// What would do, by the least wasteful of the simulated fits: a bound, or readings.
std::string not_confirmed_text(const PlanningTask& task, const PlanningAnswer& answer) {
  const std::string begin = "\nNot confirmed: the bound meets the goal";
  const auto of_fits_mm = [](const Recommendation& one) {
    return std::max(one.confirmed.u_expanded_mm, one.confirmed.stated_mm);
  };
  const Recommendation* best = nullptr;
  for (const Recommendation& one : answer.not_confirmed) {
    if (one.confirmed.repeats == 0) continue;
    if (!best ||
        of_fits_mm(one) / one.plan.u_expanded_mm < of_fits_mm(*best) / best->plan.u_expanded_mm)
      best = &one;
  }
  if (!best) return begin + ", the simulated fits do not\n";
  if (best->confirmed.misses) {
    return begin + format(", the simulated fits do not; ask for a bound of {} µm (--goal-um)\n",
                          um(task.goal_mm * best->plan.u_expanded_mm / of_fits_mm(*best)));
  }
  // More readings per revolution would only correlate: more turns do not.
  const double ratio = best->confirmed.stated_mm / task.goal_mm, times = ratio * ratio;
  return begin +
         format(
             " of {} µm, but the U that the fits state does not: {} µm, {} times the goal; use "
             "about {} times the turns (a feed of {} mm), or remove what the fits treat as noise\n",
             um(task.goal_mm), um(best->confirmed.stated_mm), digits(3, ratio), digits(2, times),
             digits(2, best->plan.of(Choice::feed) / times));
}

/// The list of plans under a headline.
std::string plans_text(const PlanningTask& task, const std::vector<Recommendation>& list,
                       const std::string& headline) {
  if (list.empty()) return "";
  std::string text = format("\n{} (seed {})\n  {}", headline, task.seed, table_head);
  for (const Recommendation& one : list) {
    text += "  " + row_text(one.plan) + "  " + one.what + '\n';
    text += confirmed_text(one.confirmed, task.goal_mm);
  }
  return text;
}

}  // namespace

std::string planning_text(const PlanningTask& task, const PlanningAnswer& answer) {
  const bool face = task.base.part.kind == virtual_lathe::PartKind::face;
  std::string text =
      format("U({}) ≤ {} µm, k = {:g}\n\nThe plan as it is\n  {}  {}\n", face ? "face" : "axis",
             um(task.goal_mm), task.coverage_factor, table_head, row_text(answer.as_given));
  if (!answer.alone.empty()) text += alone_text(task, answer);
  if (!answer.table.empty()) {
    text += format("\nOver the ranges, {} as needed\n  {}", info_of(answer.solved_for).words,
                   table_head);
    for (const TableRow& row : answer.table)
      text += "  " + row_text(row.plan) + (row.reached ? "" : "  misses the goal") +
              beyond_text(task, row.plan) + '\n';
  }
  text += plans_text(task, answer.recommended, "Recommended, and confirmed by simulation");
  text +=
      plans_text(task, answer.not_confirmed, "Not recommended: by the bound only, as simulated");
  for (const std::string& remark : answer.remarks) text += "\nNote: " + remark + '\n';
  if (answer.reached && !answer.confirmed) text += not_confirmed_text(task, answer);
  return answer.reached ? text : text + not_reached_text(task, answer);
}

}  // namespace trueaxis
