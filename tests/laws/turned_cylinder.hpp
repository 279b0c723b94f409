// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {

/// A cylinder probed in one pass of 30 turns, σ 2 µm.
inline virtual_lathe::Scenario turned_cylinder() {
  virtual_lathe::Scenario scenario = probed_part(virtual_lathe::PartKind::cylinder);
  scenario.noise.sigma_mm = 0.002;
  scenario.plan.passes[0].end_mm = 30.0;
  scenario.plan.passes[0].feed_mm_per_rev = 1.0;
  scenario.plan.passes[0].readings_per_revolution = 24.3;
  return scenario;
}

/// The same with less noise.
inline virtual_lathe::Scenario turned_cylinder(std::uint64_t seed, double radius_mm,
                                               double sigma_mm) {
  virtual_lathe::Scenario scenario = turned_cylinder();
  scenario.seed = seed, scenario.part.radius_mm = radius_mm, scenario.noise.sigma_mm = sigma_mm;
  return scenario;
}

inline Diagnosis diagnosed_cylinder(const ProbeStream& stream, bool bore = false) {
  DiagnoseOptions options;
  options.fit.bore = bore;
  options.fit.surface = SurfaceKind::cylinder;
  options.threads = 1;
  return diagnose(stream, options);
}

/// The final axis at both ends is that of the part, which slipped by (dx, dy). One of 16 000 is
/// beyond 4 u.
inline void expect_axis_after(const virtual_lathe::Scenario& scenario, double dx_mm, double dy_mm,
                              double end_mm, const Diagnosis& diagnosis) {
  const virtual_lathe::Part& part = scenario.part;
  const double n = std::sqrt(1.0 - part.l * part.l - part.m * part.m);
  for (const double z_mm : {0.0, end_mm}) {
    const auto stated = diagnosis.extended.axis.axis.at(z_mm);
    const double u = diagnosis.extended.axis.u_at(z_mm);
    EXPECT_NEAR(stated[0], part.x0_mm + part.l / n * z_mm + dx_mm, 4.0 * u) << scenario.seed;
    EXPECT_NEAR(stated[1], part.y0_mm + part.m / n * z_mm + dy_mm, 4.0 * u) << scenario.seed;
  }
}

}  // namespace trueaxis::testing
