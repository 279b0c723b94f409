// SPDX-License-Identifier: Apache-2.0
#include "job/machine/machine_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "job/machine/axis_ranges.hpp"

namespace trueaxis::machine_job {
namespace {

constexpr double same_length_mm = 0.5;
constexpr std::size_t most_named = 3;

std::string um_text(double length_mm) { return fmt::format("{:.3g} µm", length_mm / mm_per_um); }

std::string beyond_text(const AxisRange& range) {
  return fmt::format("the program has {} and it was measured {}",
                     range_text(range.axis, (*range.program)[0], (*range.program)[1]),
                     range_text(range.axis, range.measured_low, range.measured_high).substr(2));
}

/// The axis that takes the tip along by what was found and no program corrects.
std::optional<AxisName> axis_of(const MachineTerm& term) {
  if (const auto* sense = std::get_if<ErrorOfSense>(&term)) return sense->axis;
  const auto* error = std::get_if<ErrorOfPosition>(&term);
  if (error != nullptr && error->of) return static_cast<AxisName>(error->error.body);
  return std::nullopt;
}

/// Largest motion of the tip by 1 mm or rad of an axis.
double largest_gain(const MachineModel& model, AxisName axis, const std::vector<Stand>& stands) {
  double most = 0.0;
  for (const Stand& stand : stands) {
    const Vector3 by = model.jacobian(stand.axes, stand.setting)[index_of(axis)].tip_mm;
    most = std::max(most, std::hypot(by[0], by[1], by[2]));
  }
  return most;
}

/// Lengths of the tool at which was measured and at which the program cuts.
std::set<double> measured_lengths_mm(const MachineJob& job) {
  std::set<double> lengths;
  for (const MachineMeasurement& file : job.data) {
    if (file.kind == MeasurementKind::axis) continue;
    if (file.tool_length_mm.empty()) lengths.insert(job.machine.tool.length_mm);
    lengths.insert(file.tool_length_mm.begin(), file.tool_length_mm.end());
  }
  return lengths;
}

std::string tool_reservation(const MachineJobResult& result) {
  const std::set<double> measured = measured_lengths_mm(result.job);
  if (measured.empty()) return "";
  for (const ProgramEnd& end : result.compensation->ends) {
    const double length = end.setting.tool_length_mm;
    if (end.rapid || (length > *measured.begin() - same_length_mm &&
                      length < *measured.rbegin() + same_length_mm))
      continue;
    const double beyond_mm =
        std::min(std::abs(length - *measured.begin()), std::abs(length - *measured.rbegin()));
    return fmt::format(
        "line {} cuts with a tool of {:.6g} mm, {:.3g} mm from the lengths that were measured: a "
        "tilt of the spindle of 0.2 mrad, which they do not show, would move its tip by {}",
        end.line, length, beyond_mm, um_text(beyond_mm * CalibrationOptions{}.largest_angle_rad));
  }
  return "";
}

std::string rivals_text(const MachineFinding& found) {
  std::vector<std::string> names;
  for (const Rival& rival : found.rivals) names.push_back(rival.effect);
  const std::size_t more = names.size() > most_named ? names.size() - most_named : 0;
  names.resize(names.size() - more);
  std::string text = fmt::format("{} is not told from {}{}", found.effect, fmt::join(names, ", "),
                                 more > 0 ? fmt::format(" and {} more", more) : "");
  if (found.separate_with && !found.separate_with->plan.empty())
    text += fmt::format(" (plan {} tells them apart: {})", found.separate_with->plan,
                        found.separate_with->what);
  return text;
}

}  // namespace

namespace {

/// Where the part stands as a whole has six numbers, which the errors of three points and fewer,
/// nine numbers and fewer, are nearly taken up by: what is left of them says nothing.
std::string too_few_cuts(const ProgramCompensation& compensation) {
  constexpr std::ptrdiff_t fewest = 4;
  const auto cuts =
      std::ranges::count_if(compensation.ends, [](const ProgramEnd& end) { return !end.rapid; });
  return cuts >= fewest ? std::string()
                        : fmt::format(
                              "the program has {} cutting moves, of which nothing is left "
                              "beside where the part stands; {} are the fewest",
                              cuts, fewest);
}

}  // namespace

std::string machine_objection(const MachineJobResult& result) {
  const Calibration& base = result.diagnosis.baseline;
  if (!base.converged) return "the errors were not found: " + base.message;
  if (!result.implausible.empty()) return result.implausible;
  if (!result.compensation) return "";
  if (result.compensation->unreachable.empty()) return too_few_cuts(*result.compensation);
  const auto& blocks = result.compensation->unreachable;
  return fmt::format("{} of the program's blocks cannot be reached, the first in line {}: {}",
                     blocks.size(), blocks.front().line, blocks.front().why);
}

std::string extrapolated(const MachineJobResult& result) {
  for (const MachineFinding& found : result.diagnosis.findings)
    for (const ErrorTerm& error : found.errors)
      for (const AxisRange& range : result.ranges)
        if (error.name.component && error.name.body == index_of(range.axis) &&
            beyond_measured(range))
          return fmt::format(
              "{} was found, {}: what it is beyond is not known; measure where the part is cut",
              found.effect, beyond_text(range));
  return "";
}

std::vector<std::string> machine_reservations(const MachineJobResult& result) {
  std::vector<std::string> all;
  for (const MachineFinding& found : result.diagnosis.findings) {
    if (!found.rivals.empty()) all.push_back(rivals_text(found));
    if (!is_machine_error(found.term))
      all.push_back(fmt::format("{} was found: {}", found.effect, found.consequence));
  }
  all.insert(all.end(), result.diagnosis.remarks.begin(), result.diagnosis.remarks.end());
  for (const QualityCheck& check : result.diagnosis.checks)
    if (check.found) all.push_back(check.effect + ": " + check.text);
  for (const MachineUnexplained& one : result.diagnosis.unexplained)
    all.push_back(fmt::format("{} of {} that no effect explains, counted with U", one.pattern,
                              um_text(one.amplitude.value)));
  for (const AxisRange& range : result.ranges)
    if (beyond_measured(range))
      all.push_back(beyond_text(range) + ": errors of the axis beyond are not known");
  if (result.compensation)
    if (std::string why = tool_reservation(result); !why.empty()) all.push_back(std::move(why));
  return all;
}

double not_corrected_mm(const MachineJobResult& result, const MachineModel& model,
                        const std::vector<Stand>& stands) {
  double sum = 0.0;
  for (const MachineFinding& found : result.diagnosis.findings) {
    if (std::holds_alternative<TipDrift>(found.term)) sum += std::abs(found.size);
    if (const auto axis = axis_of(found.term))
      sum += std::abs(found.size) * largest_gain(model, *axis, stands);
  }
  for (const MachineUnexplained& one : result.diagnosis.unexplained)
    sum += std::abs(one.amplitude.value);
  return sum;
}

std::vector<std::string> machine_remarks(const MachineJobResult& result) {
  std::vector<std::string> all;
  const auto& held = result.diagnosis.baseline.not_determined;
  const bool places = std::ranges::any_of(held, [](const NotDetermined& one) {
    return std::ranges::find(one.members, "ball") != one.members.end();
  });
  if (places)
    all.emplace_back(
        "Where the part stands as a whole is not known, as no ball's place is: the "
        "numbers are of the part without that, and hold once its zero point is probed on this "
        "machine.");
  if (measured_lengths_mm(result.job).size() == 1)
    all.emplace_back(
        "One length of tool does not show the direction of the spindle: it shows where the tip "
        "is, and directions are those of the errors that were found.");
  const bool no_u = std::ranges::any_of(result.job.known.terms,
                                        [](const ErrorTerm& term) { return !(term.u > 0.0); });
  const auto& unsaid = result.job.remarks_of_known;
  all.insert(all.end(), unsaid.begin(), unsaid.end());
  if (no_u) all.emplace_back("Errors known beforehand that state no u are taken as exact.");
  if (result.compensation && !result.compensation->singular.empty())
    all.push_back(fmt::format(
        "At a pole of the machine {} blocks keep the tip and leave up to {:.3g} deg of direction.",
        result.compensation->singular.size(),
        std::ranges::max(result.compensation->singular, {}, &SingularBlock::direction_left_rad)
                .direction_left_rad /
            rad_per_deg));
  return all;
}

std::string next_plan_text(const MachineDiagnosis& diagnosis) {
  const auto plan = std::ranges::find(diagnosis.plans, diagnosis.next_plan, &MachinePlan::code);
  if (diagnosis.next_plan.empty() || plan == diagnosis.plans.end()) return "";
  return fmt::format("plan {}: {} ({:.0f} min)", plan->code, plan->what, plan->minutes);
}

}  // namespace trueaxis::machine_job
