// SPDX-License-Identifier: Apache-2.0
#include "job/machine/machine_doubts.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "job/machine/machine_job_steps.hpp"

namespace trueaxis::machine_job {
namespace {

constexpr double same_length_mm = 0.5;
constexpr std::size_t most_named = 3;

/// Where the program has an axis and where it was measured, as at the edge.
Reason beyond(const AxisRange& range, ReasonCode code) {
  const bool rotary = is_rotary(range.axis);
  const double unit = rotary ? rad_per_deg : 1.0;
  const char* name = rotary ? "deg" : "mm";
  return {code,
          {},
          {{"program_low", (*range.program)[0] / unit, name},
           {"program_high", (*range.program)[1] / unit, name},
           {"measured_low", range.measured_low / unit, name},
           {"measured_high", range.measured_high / unit, name}},
          {{"axis", std::string(1, letter_of(range.axis))}, {"unit", name}}};
}

double length(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

/// Largest motion of the tip by 1 mm or rad of an axis.
double largest_gain(const MachineModel& model, AxisName axis, const std::vector<Stand>& stands) {
  double most = 0.0;
  for (const Stand& stand : stands)
    most = std::max(most, length(model.jacobian(stand.axes, stand.setting)[index_of(axis)].tip_mm));
  return most;
}

/// The same by 1 mm or rad of an error.
double largest_gain(const MachineModel& model, const ErrorName& error,
                    const std::vector<Stand>& stands) {
  ErrorModel unit;
  unit.reference_mm = model.errors().reference_mm;
  unit.terms.push_back({error, ConstantError{1.0}});
  const MachineModel alone(model.machine(), unit);
  double most = 0.0;
  for (const Stand& stand : stands)
    most = std::max(most, length(alone.linear_error(stand.axes, stand.setting).tip_mm));
  return most;
}

/// Largest motion of the tip by something of this size, mm or rad; none: the machine does not move
/// by it.
std::optional<double> at_tip_mm(const MachineTerm& term, double size, const MachineModel& model,
                                const std::vector<Stand>& stands) {
  if (std::holds_alternative<TipDrift>(term)) return std::abs(size);
  if (const auto* sense = std::get_if<ErrorOfSense>(&term))
    return std::abs(size) * largest_gain(model, sense->axis, stands);
  if (const auto* error = std::get_if<ErrorOfPosition>(&term))
    return std::abs(size) * largest_gain(model, error->error, stands);
  return std::nullopt;
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

std::optional<Reason> tool_reservation(const MachineJobResult& result) {
  const std::set<double> measured = measured_lengths_mm(result.job);
  if (measured.empty()) return {};
  for (const ProgramEnd& end : result.compensation->ends) {
    const double length = end.setting.tool_length_mm;
    if (end.rapid || (length > *measured.begin() - same_length_mm &&
                      length < *measured.rbegin() + same_length_mm))
      continue;
    const double beyond_mm =
        std::min(std::abs(length - *measured.begin()), std::abs(length - *measured.rbegin()));
    return Reason{ReasonCode::tool_length_not_measured,
                  {},
                  {{"line", static_cast<double>(end.line)},
                   {"length", length, "mm"},
                   {"beyond", beyond_mm, "mm"},
                   {"moved", beyond_mm * CalibrationOptions{}.largest_angle_rad, "mm"}}};
  }
  return {};
}

Reason not_told(const MachineFinding& found) {
  std::vector<std::string> names;
  for (const Rival& rival : found.rivals) names.push_back(rival.effect);
  const std::size_t more = names.size() > most_named ? names.size() - most_named : 0;
  names.resize(names.size() - more);
  Reason reason{
      ReasonCode::finding_not_told,
      {},
      {},
      {{"effect", found.effect()}, {"rivals", fmt::format("{}", fmt::join(names, ", "))}}};
  if (more > 0) reason.numbers = {{"more", static_cast<double>(more)}};
  if (found.separate_with && !found.separate_with->plan.empty())
    reason.names.insert(reason.names.end(),
                        {{"plan", found.separate_with->plan}, {"what", found.separate_with->what}});
  return reason;
}

/// A job judges the tip on the cutting moves.
bool is_of_cuts(const Reason& reason) { return reason.code == ReasonCode::ways_not_counted; }

/// The place of the part as a whole has six numbers. They nearly take up the errors of three points
/// and fewer, nine numbers and fewer, so that the residual says nothing.
std::optional<Reason> too_few_cuts(const ProgramCompensation& compensation) {
  constexpr std::ptrdiff_t fewest = 4;
  const auto cuts =
      std::ranges::count_if(compensation.ends, [](const ProgramEnd& end) { return !end.rapid; });
  if (cuts >= fewest) return {};
  return Reason{ReasonCode::too_few_cuts,
                {},
                {{"cuts", static_cast<double>(cuts)}, {"fewest", static_cast<double>(fewest)}}};
}

}  // namespace

std::optional<Reason> machine_objection(const MachineJobResult& result) {
  const Calibration& base = result.diagnosis.baseline;
  if (!base.converged)
    return Reason{ReasonCode::errors_not_found, {}, {}, {{"message", base.message}}};
  if (!result.implausible.empty())
    return Reason{ReasonCode::errors_implausible, {}, {}, {{"why", result.implausible}}};
  if (!result.compensation) return {};
  const auto& blocks = result.compensation->unreachable;
  if (blocks.empty()) return too_few_cuts(*result.compensation);
  return Reason{ReasonCode::blocks_unreachable,
                {},
                {{"blocks", static_cast<double>(blocks.size())},
                 {"line", static_cast<double>(blocks.front().line)}},
                {{"why", blocks.front().why}}};
}

std::optional<Reason> extrapolated(const MachineJobResult& result) {
  for (const MachineFinding& found : result.diagnosis.findings)
    for (const ErrorTerm& error : found.errors)
      for (const AxisRange& range : result.ranges)
        if (error.name.component && error.name.body == index_of(range.axis) &&
            beyond_measured(range)) {
          Reason reason = beyond(range, ReasonCode::found_not_measured_there);
          reason.names.push_back({"effect", found.effect()});
          return reason;
        }
  return {};
}

Reasons machine_reservations(const MachineJobResult& result) {
  Reasons all;
  for (const MachineFinding& found : result.diagnosis.findings) {
    if (!found.rivals.empty()) all.push_back(not_told(found));
    if (!is_machine_error(found.cause.term))
      all.push_back({ReasonCode::finding_counted,
                     {},
                     {},
                     {{"effect", found.effect()}, {"consequence", found.cause.consequence}}});
  }
  for (const std::string& remark : result.diagnosis.remarks)
    all.push_back({ReasonCode::remark, {}, {}, {{"text", remark}}});
  for (const QualityCheck& check : result.diagnosis.checks)
    if (check.found)
      all.push_back(
          {ReasonCode::check_found, {}, {}, {{"check", check.effect}, {"text", check.text}}});
  for (const MachineUnexplained& one : result.diagnosis.unexplained) {
    const bool angle = one.amplitude.unit == "rad";
    const char* unit = angle ? "rad" : "mm";
    all.push_back({ReasonCode::pattern_counted,
                   {},
                   {{angle ? "angle" : "amplitude", one.amplitude.value, unit},
                    {angle ? "angle_left" : "amplitude_left", one.left, unit}},
                   {{"pattern", one.pattern}}});
  }
  for (const AxisRange& range : result.ranges)
    if (beyond_measured(range)) all.push_back(beyond(range, ReasonCode::axis_not_measured_there));
  if (!result.compensation) return all;
  if (auto why = tool_reservation(result)) all.push_back(std::move(*why));
  std::ranges::copy_if(result.compensation->reservations, std::back_inserter(all), is_of_cuts);
  return all;
}

double not_corrected_mm(const MachineJobResult& result, const MachineModel& model,
                        const std::vector<Stand>& stands) {
  double sum = 0.0;
  const bool of_calibration = !result.diagnosis.unexplained.empty();
  for (const MachineFinding& found : result.diagnosis.findings) {
    // An order corrected in the place of another leaves both. The errors of a calibration, which
    // are used if something is unexplained, have no order in the place of another.
    const double times = !is_machine_error(found.cause.term)    ? 1.0
                         : found.likely_order || of_calibration ? 0.0
                                                                : 2.0;
    if (times > 0.0)
      sum += times * at_tip_mm(found.cause.term, found.size, model, stands).value_or(0.0);
  }
  for (const MachineUnexplained& one : result.diagnosis.unexplained)
    sum += at_tip_mm(one.term, one.left, model, stands).value_or(one.left);
  return sum;
}

Reasons machine_remarks(const MachineJobResult& result) {
  Reasons all;
  const auto& held = result.diagnosis.baseline.not_determined;
  const bool places = std::ranges::any_of(held, [](const NotDetermined& one) {
    return std::ranges::find(one.members, "ball") != one.members.end();
  });
  if (places)
    all.push_back(
        {ReasonCode::place_of_part_unknown, {}, {}, {}, {{ReasonCode::of_the_part_alone}}});
  if (measured_lengths_mm(result.job).size() == 1)
    all.push_back({ReasonCode::one_tool_length, {}, {}, {}, {{ReasonCode::of_found_directions}}});
  const bool no_u = std::ranges::any_of(result.job.known.terms,
                                        [](const ErrorTerm& term) { return !(term.u > 0.0); });
  for (const std::string& unsaid : result.job.remarks_of_known)
    all.push_back({ReasonCode::remark, {}, {}, {{"text", unsaid}}});
  if (no_u) all.push_back({ReasonCode::known_without_u});
  if (!result.compensation) return all;
  for (const std::string& assumed : result.compensation->remarks)
    all.push_back({ReasonCode::remark, {}, {}, {{"text", assumed}}});
  std::ranges::copy_if(result.compensation->reservations, std::back_inserter(all),
                       std::not_fn(is_of_cuts));
  if (result.compensation->singular.empty()) return all;
  const auto& poles = result.compensation->singular;
  all.push_back(
      {ReasonCode::at_a_pole,
       {},
       {{"blocks", static_cast<double>(poles.size())},
        {"left", std::ranges::max(poles, {}, &SingularBlock::direction_left_rad).direction_left_rad,
         "rad"}}});
  return all;
}

std::optional<Reason> between_positions(const MachineDiagnosis& diagnosis) {
  for (const MachineFinding& found : diagnosis.findings) {
    const auto axis = axis_of(found.cause.term);
    if (!found.likely_order && axis)
      return Reason{
          ReasonCode::measure_between, {}, {}, {{"axis", std::string(1, letter_of(*axis))}}};
  }
  return {};
}

std::optional<Reason> next_plan(const MachineDiagnosis& diagnosis) {
  const MachinePlan* plan = diagnosis.next();
  if (plan == nullptr) return {};
  return Reason{ReasonCode::plan,
                {},
                {{"minutes", plan->minutes, "min"}},
                {{"plan", plan->code}, {"what", plan->what}}};
}

}  // namespace trueaxis::machine_job
