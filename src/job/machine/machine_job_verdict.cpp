// SPDX-License-Identifier: Apache-2.0
#include "job/machine/machine_job_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "job/machine/machine_doubts.hpp"

namespace trueaxis::machine_job {
namespace {

/// "2.7 µm", with two digits of it.
std::string in_um(double length_mm) {
  const double um = length_mm / mm_per_um;
  return fmt::format("{:.{}f} µm", um, decimals_of(um, 0));
}

std::string numbers_text(const MachineJobVerdict& v) {
  return fmt::format(
      "tip off by at most {} with the new program (in 95 of 100), {} on its path without it",
      in_um(v.upper_mm), in_um(v.path_before_mm()));
}

/// Why the new program is no better than the old one; empty: it is.
std::string worse(const MachineJobResult& result, const MachineJobVerdict& v) {
  if (!result.compensation || result.tips.empty()) return "";
  constexpr double stated_to = 1.01;
  const double by_decimals_mm = 2.0 * result.compensation->rounding.position.value;
  if (v.path_after_mm() <= stated_to * v.path_before_mm() + by_decimals_mm) return "";
  return fmt::format("the new program is off by {} on its path, the old one by {}; {}",
                     in_um(v.path_after_mm()), in_um(v.path_before_mm()),
                     v.between_mm > v.after_mm
                         ? "cut its blocks in pieces with [program] tolerance_um"
                         : "ask for more [program] decimals");
}

/// What would bring the tip within its tolerance: the largest part of what it is off by.
std::string remedy(const MachineJobResult& result, const MachineJobVerdict& v,
                   double tolerance_mm) {
  const double left_mm = v.path_after_mm();
  const double budget_mm = tolerance_mm - v.not_corrected_mm - v.U_mm;
  if (v.between_mm > v.after_mm && v.between_mm > std::max(v.U_mm, v.not_corrected_mm)) {
    const double pieces_um = std::floor(0.8 * budget_mm / mm_per_um);
    return pieces_um >= 1.0
               ? fmt::format(
                     "between its blocks the tip leaves the line by {}: cut them in pieces "
                     "with [program] tolerance_um = {:.0f}",
                     in_um(v.between_mm), pieces_um)
               : fmt::format("between its blocks the tip leaves the line by {}",
                             in_um(v.between_mm));
  }
  if (v.not_corrected_mm > v.U_mm)
    return fmt::format("{} of it is what was found and no program corrects",
                       in_um(v.not_corrected_mm));
  const double room_mm = tolerance_mm - left_mm - v.not_corrected_mm;
  std::size_t rows = 0;
  for (const MachineMeasurement& file : result.job.data) rows += file.rows();
  if (room_mm > 0.0 && v.U_mm > room_mm)
    return fmt::format("U is {}, and some {:.2g} times the {} rows, as the square of U, would do",
                       in_um(v.U_mm), std::pow(v.U_mm / room_mm, 2), rows);
  const std::string plan = next_plan_text(result.diagnosis);
  return plan.empty() ? "" : "measure " + plan;
}

MachineJobVerdict ends_as(MachineJobVerdict v, Decision decision, std::string line) {
  v.decision = decision;
  v.line = std::move(line);
  return v;
}

MachineJobVerdict by_tolerance(const MachineJobResult& result, MachineJobVerdict v,
                               double tolerance_mm) {
  const std::string numbers =
      numbers_text(v) + fmt::format(", tolerance {:.9g} µm", tolerance_mm / mm_per_um);
  if (v.upper_mm <= tolerance_mm) return ends_as(std::move(v), Decision::go, "GO: " + numbers);
  v.next = remedy(result, v, tolerance_mm);
  const std::string then = v.next.empty() ? "" : "; " + v.next;
  if (v.lower_mm > tolerance_mm) {
    std::string line =
        fmt::format("NO-GO: {}, and at least {}{}", numbers, in_um(v.lower_mm), then);
    return ends_as(std::move(v), Decision::no_go, std::move(line));
  }
  return ends_as(std::move(v), Decision::not_proven, "NOT PROVEN: " + numbers + then);
}

std::string next_of(const MachineJobResult& result, const MachineJobVerdict& v) {
  const std::string plan = next_plan_text(result.diagnosis);
  if (!v.go()) return "Mend what the verdict names, and run the job again.";
  if (!result.job.program)
    return "Name the part's program in a [program] table, and run the job again.";
  std::string text =
      "Probe the part's zero point on this machine, and run the new program in place of the old "
      "one.";
  if (!v.reservations.empty() && !plan.empty()) text += " To lift the reservations: " + plan + ".";
  return text;
}

MachineJobVerdict without_next(const MachineJobResult& result, MachineJobVerdict v) {
  const double left_mm = v.path_after_mm();
  v.upper_mm = left_mm + v.not_corrected_mm + v.U_mm;
  v.lower_mm = std::max(0.0, left_mm - v.U_mm);
  if (const std::string why = machine_objection(result); !why.empty())
    return ends_as(std::move(v), Decision::no_go, "NO-GO: " + why);
  if (const std::string why = worse(result, v); !why.empty())
    return ends_as(std::move(v), Decision::no_go, "NO-GO: " + why);
  v.reservations = machine_reservations(result);
  if (!result.job.program) {
    v = ends_as(std::move(v), Decision::identified,
                "DONE: errors of the machine identified, no program to compensate");
  } else if (const std::string why = extrapolated(result); !why.empty()) {
    return ends_as(std::move(v), Decision::not_proven, "NOT PROVEN: " + why);
  } else if (!result.job.tolerance_mm) {
    std::string line = "DONE, no tolerance given: " + numbers_text(v);
    v = ends_as(std::move(v), Decision::untoleranced, std::move(line));
  } else {
    v = by_tolerance(result, std::move(v), *result.job.tolerance_mm);
    if (v.decision != Decision::go) return v;
    if (!v.reservations.empty())
      v = ends_as(v, Decision::go_with_reservations, "GO with reservations" + v.line.substr(2));
  }
  for (const std::string& reservation : v.reservations) v.line += "; " + reservation;
  return v;
}

}  // namespace

MachineJobVerdict decide(const MachineJobResult& result, MachineJobVerdict numbers) {
  MachineJobVerdict v = without_next(result, std::move(numbers));
  if (v.next.empty()) {
    v.next = next_of(result, v);
  } else {
    v.next[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(v.next[0])));
    v.next += '.';
  }
  return v;
}

}  // namespace trueaxis::machine_job
