// SPDX-License-Identifier: Apache-2.0
#include "study/planning/probing_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {
namespace {

using virtual_lathe::Chucking;
using virtual_lathe::Part;
using virtual_lathe::PartKind;
using virtual_lathe::PlannedPass;
using virtual_lathe::Scenario;

nc::ProbingPass driven(const PlannedPass& pass, bool rear) {
  nc::ProbingPass out;
  out.start_mm = pass.start_mm, out.end_mm = pass.end_mm, out.rear = rear;
  out.c_rad = pass.c_start_rad.value_or(0.0);
  if (pass.speed_rpm == 0.0) {
    out.seconds = pass.duration_s;
    out.readings = static_cast<std::size_t>(std::ceil(pass.duration_s * pass.rate_hz));
    return out;
  }
  const double turns = pass.start_mm != pass.end_mm
                           ? std::abs(pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev
                           : pass.revolutions;
  out.turns = std::copysign(turns, pass.speed_rpm);
  out.seconds = 60.0 * turns / std::abs(pass.speed_rpm);
  out.readings = static_cast<std::size_t>(turns * pass.readings_per_revolution + 1e-9) + 1;
  return out;
}

/// Radius at z = 0 and its slope, where the passes are; of a face its Z at the centre.
void take_shape(const Scenario& scenario, nc::ProbingPlan& plan) {
  const Part& part = scenario.part;
  if (part.kind == PartKind::face) {
    plan.surface = nc::ProbedSurface::face;
    plan.size_mm = part.d_mm / std::sqrt(1.0 - part.l * part.l - part.m * part.m);
    return;
  }
  if (part.bore) plan.surface = nc::ProbedSurface::bore;
  plan.size_mm = part.radius_mm;
  if (part.kind != PartKind::cone) return;
  const double tangent = std::tan(part.half_angle_rad);
  if (part.apex_mm) {
    const double side = scenario.plan.passes.front().start_mm < *part.apex_mm ? -1.0 : 1.0;
    plan.slope = side * tangent, plan.size_mm = -plan.slope * *part.apex_mm;
  } else {
    plan.slope = tangent, plan.size_mm -= tangent * part.radius_at_mm;
  }
}

void take_shape(const FitResult& fit, nc::ProbingPlan& plan) {
  if (fit.surface == SurfaceKind::plane) {
    const double l = fit.parameter("l").value, m = fit.parameter("m").value;
    plan.surface = nc::ProbedSurface::face;
    plan.size_mm = fit.parameter("d").value / std::sqrt(1.0 - l * l - m * m);
    return;
  }
  if (fit.bore) plan.surface = nc::ProbedSurface::bore;
  plan.slope = fit.shape.tan_half_angle;
  plan.size_mm = fit.shape.radius_mm - plan.slope * fit.shape.axis.z_ref_mm;
}

}  // namespace

nc::ProbingPlan probing_plan(const Scenario& scenario) {
  std::vector<Diagnostic> wrong;
  const auto refuse = [&](std::string why) { wrong.push_back({"", 0, 0, std::move(why)}); };
  if (!scenario.probe.sensor_angles_rad.empty())
    refuse("a probing program has one probe, not several sensors");
  nc::ProbingPlan plan;
  take_shape(scenario, plan);
  for (const PlannedPass& pass : scenario.plan.passes) {
    const auto found = std::ranges::find(scenario.plan.setups, pass.setup, &Chucking::number);
    const Chucking chucking = found == scenario.plan.setups.end() ? Chucking{} : *found;
    if (chucking.reindex_rad != 0.0 || chucking.z_shift_mm != 0.0 ||
        chucking.clamp_force_ratio != 1.0 || chucking.x_jog_mm != 0.0 || chucking.x0_mm ||
        chucking.y0_mm || chucking.l || chucking.m)
      refuse(fmt::format("set-up {} needs a hand at the chuck or slide: plan each clamping alone",
                         pass.setup));
    plan.passes.push_back(driven(pass, chucking.rear));
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return plan;
}

std::vector<nc::ProbingPlan> probing_plans(const Diagnosis& diagnosis) {
  const FitResult& fit = diagnosis.extended;
  std::vector<nc::ProbingPlan> out;
  for (std::size_t k = 0; k < diagnosis.plans.size(); ++k) {
    const Separating& measure = diagnosis.plans[k];
    if (diagnosis.runs[k].empty() || !(measure.power > measure.power_before)) continue;
    nc::ProbingPlan& plan = out.emplace_back();
    plan.what = measure.what;
    take_shape(fit, plan);
    for (const ProbingRun& run : diagnosis.runs[k])
      plan.passes.push_back({run.from_mm, run.to_mm, run.turns, run.seconds,
                             static_cast<std::size_t>(std::lround(run.readings)), run.c_rad,
                             run.rear});
  }
  return out;
}

}  // namespace trueaxis::study
