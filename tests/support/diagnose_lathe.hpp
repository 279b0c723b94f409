// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {

/// A part 0.2 mm off and tilted by 1 mrad on the virtual lathe, probed once from end to end at
/// 60 rpm; white noise.
inline virtual_lathe::Scenario one_pass(double tangent, double turns, double sigma_mm) {
  virtual_lathe::Scenario scenario;
  scenario.part.kind =
      tangent == 0.0 ? virtual_lathe::PartKind::cylinder : virtual_lathe::PartKind::cone;
  scenario.part.half_angle_rad = std::atan(tangent);
  scenario.part.radius_mm = 40.0;
  scenario.part.x0_mm = 0.16, scenario.part.y0_mm = -0.12;
  scenario.part.l = 8e-4, scenario.part.m = 6e-4;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = 0.0, pass.end_mm = 60.0;
  pass.feed_mm_per_rev = 60.0 / turns;
  pass.readings_per_revolution = 23.7;
  scenario.plan.passes = {pass};
  scenario.u_start_mm = 0.0, scenario.u_end_mm = 60.0;
  scenario.noise.sigma_mm = sigma_mm;
  return scenario;
}

inline DiagnoseOptions on_one_core(const virtual_lathe::Scenario& scenario) {
  DiagnoseOptions options;
  options.fit.surface = scenario.part.kind == virtual_lathe::PartKind::cylinder
                            ? SurfaceKind::cylinder
                            : SurfaceKind::cone;
  options.threads = 1;
  return options;
}

/// The cause whose class holds an effect; nullptr: none.
inline const Finding* finding_with(const Diagnosis& diagnosis, const std::string& effect) {
  for (const Finding& f : diagnosis.findings)
    if (f.may_be(effect)) return &f;
  return nullptr;
}

inline const Estimate* parameter_of(const Finding& finding, const std::string& name) {
  for (const FitParameter& p : finding.parameters)
    if (p.name == name) return &p.estimate;
  return nullptr;
}

}  // namespace trueaxis::testing
