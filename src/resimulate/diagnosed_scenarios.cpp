// SPDX-License-Identifier: Apache-2.0
#include "resimulate/diagnosed_scenarios.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulate/clean_stream.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using virtual_lathe::Chucking;
using virtual_lathe::PartKind;
using virtual_lathe::Scenario;

bool at_rear(const ProbeStream& stream, const SetUp& set_up) {
  if (set_up.rear || stream.indication == Indication::relative) return set_up.rear;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (stream.setup.empty() || stream.setup[i] == set_up.number) return stream.reading_mm[i] < 0.0;
  }
  return false;
}

double secant(const Axis& axis) {
  return std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
}

/// The part as it is in a set-up. The lathe's frame moves along Z with the part: the axis is
/// asked for where it pierces z = z_shift.
Chucking chucking_of(const ProbeStream& stream, const SetUp& set_up, const Axis& axis) {
  Chucking out;
  out.number = set_up.number;
  out.reindex_rad = set_up.reindex_rad;
  out.z_shift_mm = set_up.z_shift_mm;
  out.rear = at_rear(stream, set_up);
  out.x_jog_mm = set_up.x_jog_mm;
  out.clamp_force_ratio = set_up.clamp_force_ratio;
  out.x0_mm = axis.x_mm - axis.slope_x * axis.z_ref_mm + axis.slope_x * set_up.z_shift_mm;
  out.y0_mm = axis.y_mm - axis.slope_y * axis.z_ref_mm + axis.slope_y * set_up.z_shift_mm;
  out.l = axis.slope_x / secant(axis);
  out.m = axis.slope_y / secant(axis);
  return out;
}

/// A face whose axis is where the spindle's pierces it, in every set-up at the height found
/// there: its frame's origin is so far below it as in the first.
void place_face(const FitResult& fit, Scenario& scenario) {
  virtual_lathe::Part& part = scenario.part;
  part.kind = PartKind::face;
  const bool own = fit.set_ups.size() == scenario.plan.setups.size();
  double level_mm = 0.0;
  for (std::size_t i = 0; i < scenario.plan.setups.size(); ++i) {
    Chucking& now = scenario.plan.setups[i];
    const double n = std::sqrt(1.0 - *now.l * *now.l - *now.m * *now.m);
    const double d_mm = find_parameter(own ? fit.set_ups[i].parameters : fit.parameters, "d").value;
    if (i == 0) level_mm = d_mm / (n * n), part.d_mm = d_mm, part.l = *now.l, part.m = *now.m;
    now.x0_mm = -level_mm * *now.l, now.y0_mm = -level_mm * *now.m;
    now.z_shift_mm = d_mm / n - level_mm * n;
    if (i == 0) part.x0_mm = *now.x0_mm, part.y0_mm = *now.y0_mm;
  }
}

/// Part and set-ups of a fit, its radius about the axis as it is in the last set-up.
void place_part(const FitResult& fit, const ProbeStream& stream, Scenario& scenario) {
  if (fit.status != FitStatus::converged)
    throw InputError("diagnosis", std::string("its fit is not converged (") +
                                      to_string(fit.status) + "): there is nothing to simulate");
  const Axis& last = fit.axis.axis;
  const std::vector<SetUp> set_ups = list_set_ups(stream);
  for (std::size_t i = 0; i < set_ups.size(); ++i) {
    const Axis& axis = fit.set_ups.size() == set_ups.size() ? fit.set_ups[i].axis.axis : last;
    scenario.plan.setups.push_back(chucking_of(stream, set_ups[i], axis));
  }
  virtual_lathe::Part& part = scenario.part;
  const Chucking& now = scenario.plan.setups.back();
  part.x0_mm = *now.x0_mm;
  part.y0_mm = *now.y0_mm;
  part.l = *now.l;
  part.m = *now.m;
  part.bore = fit.bore;
  if (fit.surface == SurfaceKind::plane) return place_face(fit, scenario);
  part.radius_mm = fit.shape.radius_mm;
  if (fit.surface != SurfaceKind::cone) return;
  part.kind = PartKind::cone;
  part.half_angle_rad = std::atan(fit.shape.tan_half_angle);
  part.radius_at_mm = (last.z_ref_mm - set_ups.back().z_shift_mm) * secant(last);
}

LatheFrame frame_of(const Diagnosis& diagnosis, const ProbeStream& stream) {
  LatheFrame frame{diagnosis.z_mid_mm, diagnosis.z_half_mm};
  if (!stream.time_s.empty()) {
    frame.time_start_s = stream.time_s.front();
    frame.time_end_s = stream.time_s.back();
  }
  return frame;
}

}  // namespace

std::vector<bool> marked(const std::vector<Rejected>& rows, std::size_t count) {
  std::vector<bool> marks(count, false);
  for (const Rejected& rejected : rows) {
    if (rejected.row >= 1 && rejected.row <= count) marks[rejected.row - 1] = true;
  }
  return marks;
}

bool reads_as_then(const Diagnosis& diagnosis, const ProbeStream& measured,
                   const SimulatedReadings& simulated) {
  constexpr double rounding_mm = 1e-6;
  const FitResult& fit = diagnosis.baseline;
  const Comparison first =
      compare(measured, simulated, marked(fit.rejected, measured.size()), diagnosis.noise.sigma_mm);
  return std::abs(first.before.rms_mm - fit.rms_mm) <= 0.01 * fit.rms_mm + rounding_mm;
}

DiagnosedScenarios diagnosed_scenarios(const Diagnosis& diagnosis, const ProbeStream& measured,
                                       double ball_radius_mm) {
  const std::string& hash = diagnosis.baseline.input_hash;
  if (hash != measured.input_hash)
    throw InputError("diagnosis", "is the diagnosis of another stream: its input was " + hash +
                                      ", " + measured.source + " is " + measured.input_hash);
  const LatheFrame frame = frame_of(diagnosis, measured);
  Scenario common;
  common.noise.sigma_mm = diagnosis.noise.sigma_mm;
  common.noise.autoregression = diagnosis.noise.autoregression;
  common.probe.ball_radius_mm = std::max(ball_radius_mm, measured.ball_radius_mm.value_or(0.0));
  common.probe.nominal_radius_mm = measured.nominal_radius_mm;
  if (measured.indication == Indication::relative) common.probe.relative_zero_mm = 0.0;
  common.u_start_mm = frame.z_mid_mm - frame.z_half_mm;
  common.u_end_mm = frame.z_mid_mm + frame.z_half_mm;
  DiagnosedScenarios out{common, common};
  out.before.name = "the ideal fit of " + diagnosis.baseline.source;
  out.after.name = "the final fit of " + diagnosis.baseline.source;
  place_part(diagnosis.baseline, measured, out.before);
  place_part(diagnosis.named, measured, out.after);
  const auto add = [&](const TermValue& term) {
    for (auto& effect : lathe_effects(term, frame)) out.after.effects.push_back(std::move(effect));
  };
  for (const Finding& finding : diagnosis.findings) add(finding.term);
  for (const Unexplained& pattern : diagnosis.unexplained) add(pattern.term);
  return out;
}

Resimulation resimulate(DiagnosedScenarios& scenarios, const Diagnosis& diagnosis,
                        const ProbeStream& measured) {
  const std::vector<bool> masked = marked(diagnosis.noise.masked, measured.size());
  Resimulation out;
  out.readings.before_mm = virtual_lathe::resimulate(scenarios.before, measured, masked);
  out.readings.after_mm = virtual_lathe::resimulate(scenarios.after, measured, masked);
  out.comparison = compare(measured, out.readings, masked, diagnosis.noise.sigma_mm,
                           diagnosis.noise.autoregression);
  return out;
}

Resimulation resimulate(const Diagnosis& diagnosis, const ProbeStream& measured,
                        double ball_radius_mm) {
  try {
    DiagnosedScenarios scenarios = diagnosed_scenarios(diagnosis, measured, ball_radius_mm);
    return resimulate(scenarios, diagnosis, measured);
  } catch (const InputError& error) {
    return {{}, {}, error.diagnostics().front().message};
  }
}

}  // namespace trueaxis
