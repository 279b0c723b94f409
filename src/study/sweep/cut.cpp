// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/cut.hpp"

#include <cmath>

#include "correct/coaxiality_distribution.hpp"
#include "trueaxis/correction.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;

TargetSurface target_of(const CutTarget& cut) {
  TargetSurface target;
  target.kind = cut.kind == CutKind::cone ? TargetKind::cone : TargetKind::cylinder;
  target.bore = cut.bore;
  target.z_start_mm = cut.start_mm, target.z_end_mm = cut.end_mm;
  target.radius_mm = cut.radius_mm;
  target.tan_half_angle = std::tan(cut.half_angle_rad);
  return target;
}

ToolSetup tool_of(const CutTool& cut) {
  ToolSetup tool;
  tool.nose_radius_mm = cut.nose_radius_mm;
  tool.height_mm = cut.height_mm;
  tool.angle_from_probe_rad = cut.angle_from_probe_rad;
  tool.speed_rpm = cut.speed_rpm;
  tool.sense = cut.sense;
  tool.feed_mm_per_rev = cut.feed_mm_per_rev;
  tool.c_start_rad = cut.c_start_rad;
  return tool;
}

Actuator actuator_of(const CutActuator& cut) {
  Actuator actuator;
  actuator.natural_frequency_hz = cut.natural_frequency_hz;
  actuator.damping = cut.damping;
  actuator.delay_s = cut.delay_s;
  actuator.sampling_hz = cut.sampling_hz;
  actuator.precompensate = !cut.perfect;
  return actuator;
}

CutTable table_of(const CorrectionRows& rows) {
  return {false, rows.revolution, rows.position_mm, rows.c_rad, rows.wanted_mm, rows.command_mm};
}

/// Seventeen turns and a golden share of one: no multiple of any feed that the cut would have.
Plan probing_of(const CutProgram& program) {
  constexpr double turns = 17.618033988749895;
  const CutTarget& target = program.target;
  const double way = target.end_mm < target.start_mm ? -1.0 : 1.0;
  const double within = way * program.tool.feed_mm_per_rev;
  PlannedPass pass;
  pass.start_mm = target.start_mm + within, pass.end_mm = target.end_mm - within;
  pass.feed_mm_per_rev = std::abs(pass.end_mm - pass.start_mm) / turns;
  pass.readings_per_revolution = 41.3;
  Plan plan;
  plan.passes = {pass};
  return plan;
}

}  // namespace

std::vector<Quantity> cut_quantities() { return {{"coaxiality", "mm"}, {"cut_residual", "mm"}}; }

CutOutcome cut_about(const CutProgram& program, const AxisEstimate& found, const Axis& truth) {
  const CutTarget& target = program.target;
  const Reference reference{"part", found};
  const TargetAxis axis = solve_target_axis({&reference, 1}, target.start_mm, target.end_mm);
  CutTable table;
  if (program.use != CutUse::none)
    table = table_of(make_correction(axis.axis, target_of(target), tool_of(program.tool),
                                     actuator_of(program.actuator))
                         .rows);
  const CutPart part(program, table);
  FitOptions options;
  options.surface = target.kind == CutKind::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
  options.bore = target.bore;
  const FitResult left = fit(probe_cut(part, probing_of(program), {}, 1), options);
  if (left.status != FitStatus::converged)
    throw InputError("cut", "the surface that was cut cannot be fitted: " + left.message);
  CutOutcome out;
  out.coaxiality_mm = coaxiality_mm(left.axis.axis, truth, target.start_mm, target.end_mm);
  out.at_most_mm =
      CoaxialityDistribution({&reference, 1}, axis.axis.axis, target.start_mm, target.end_mm)
          .quantile(0.95);
  out.residual_mm = left.rms_mm;
  return out;
}

}  // namespace trueaxis::study
