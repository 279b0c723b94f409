// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "io/text_layout.hpp"
#include "trueaxis/base/units.hpp"
#include "trueaxis/io/planning_results.hpp"

namespace trueaxis {
namespace {

using namespace study;
using layout::format;
using layout::padded;

std::string um(double length_mm) {
  return std::isfinite(length_mm) ? format("%.3g", length_mm / mm_per_um) : "not determined";
}

std::string u_text(double length_mm) {
  return "U is " + um(length_mm) + (std::isfinite(length_mm) ? " µm" : "");
}

const char* words_of(Choice choice) {
  switch (choice) {
    case Choice::readings_per_revolution:
      return "readings per revolution";
    case Choice::sigma:
      return "sigma of a reading";
    case Choice::feed:
      return "feed";
    case Choice::length:
      break;
  }
  return "length";
}

std::string value_text(const PlannedMeasurement& plan, Choice choice) {
  const double value = plan.of(choice);
  switch (choice) {
    case Choice::readings_per_revolution:
      return format("%.4g", value);
    case Choice::sigma:
      return format("%.3g µm", value / mm_per_um);
    case Choice::feed:
      return format("%.3g mm/rev", value);
    case Choice::length:
      break;
  }
  return format("%.3g mm", value);
}

const char* const head =
    "length    feed         per rev  sigma     readings  time      readings/s  U [µm]\n";

std::string row_text(const PlannedMeasurement& plan) {
  std::string text = padded(value_text(plan, Choice::length), 10);
  text += padded(value_text(plan, Choice::feed), 13);
  text += padded(value_text(plan, Choice::readings_per_revolution), 9);
  text += padded(value_text(plan, Choice::sigma), 10);
  text += padded(format("%zu", plan.readings), 10);
  text += padded(format("%.4g s", plan.time_s), 10);
  return text + padded(format("%.4g", plan.rate_hz), 12) + um(plan.u_expanded_mm);
}

std::string alone_text(const PlanningAnswer& answer) {
  std::string text = "\nOne thing changed, the others as they are\n";
  for (const Alone& one : answer.alone) {
    text += "  " + padded(words_of(one.choice), 26);
    text += one.reached ? value_text(one.plan, one.choice)
                        : "not in its range: at " + value_text(one.plan, one.choice) + ' ' +
                              u_text(one.plan.u_expanded_mm);
    text += one.reached ? format(" (%.4g s)\n", one.plan.time_s) : "\n";
  }
  return text;
}

std::string confirmed_text(const Confirmation& confirmed, double goal_mm) {
  if (confirmed.repeats == 0) return "    simulated: no fit ended\n";
  std::string text =
      format("    simulated %zu times: U %s µm (95 %%: %s to %s), the fits state %s µm; ",
             confirmed.repeats, um(confirmed.u_expanded_mm).c_str(),
             um(confirmed.interval_95_mm.low).c_str(), um(confirmed.interval_95_mm.high).c_str(),
             um(confirmed.stated_mm).c_str());
  text += !confirmed.at_bound                        ? "not what the bound says"
          : confirmed.interval_95_mm.high <= goal_mm ? "within the goal"
                                                     : "as the bound says, at the goal";
  if (confirmed.failures > 0) text += format(", %zu failed", confirmed.failures);
  return text + '\n';
}

}  // namespace

std::string planning_text(const PlanningTask& task, const PlanningAnswer& answer) {
  std::string text =
      format("U(axis) ≤ %s µm, k = %g\n\nThe plan as it is\n  %s  %s\n", um(task.goal_mm).c_str(),
             task.coverage_factor, head, row_text(answer.as_given).c_str());
  if (!answer.alone.empty()) text += alone_text(answer);
  if (!answer.table.empty()) {
    text += format("\nOver the ranges, %s as needed\n  %s", words_of(answer.solved_for), head);
    for (const TableRow& row : answer.table)
      text += "  " + row_text(row.plan) + (row.reached ? "\n" : "  misses the goal\n");
  }
  if (!answer.recommended.empty()) {
    text += format("\nRecommended, and confirmed by simulation (seed %llu)\n  %s",
                   static_cast<unsigned long long>(task.seed), head);
    for (const Recommendation& one : answer.recommended) {
      text += "  " + row_text(one.plan) + "  " + one.what + '\n';
      text += confirmed_text(one.confirmed, task.goal_mm);
    }
  }
  for (const std::string& remark : answer.remarks) text += "\nNote: " + remark + '\n';
  if (answer.reached) return text;
  text += std::string("\nNot reached: with the best that the ranges") +
          (task.time_s ? " and the time" : "") + " allow, " + u_text(answer.nearest.u_expanded_mm);
  if (std::isfinite(answer.nearest.u_expanded_mm))
    text += format(", %.3g times the goal", answer.nearest.u_expanded_mm / task.goal_mm);
  text += std::string("\n  ") + head + "  " + row_text(answer.nearest) + '\n';
  return text;
}

}  // namespace trueaxis
