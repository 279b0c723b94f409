// SPDX-License-Identifier: Apache-2.0
// Law: from an arc of the circumference the stated uncertainty covers the truth as often as it
// says, or the fit says that the arc does not determine the surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laws/law_case.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::laws {
namespace {

/// Passes over the same arc of C at several heights: 20 × 25 readings.
ProbeStream probe_arc(const LawCase& c, double arc_deg) {
  virtual_lathe::Scenario scenario = scenario_of(c);
  virtual_lathe::PlannedPass pass = scenario.plan.passes.front();
  scenario.plan.passes.clear();
  const int rows = c.surface == "section" ? 1 : 20;
  for (int row = 0; row < rows; ++row) {
    pass.start_mm = pass.end_mm = c.start_mm + (c.end_mm - c.start_mm) * row / 19.0;
    pass.revolutions = arc_deg / 360.0;
    pass.readings_per_revolution = (rows == 1 ? 500.0 : 24.0) / pass.revolutions;
    pass.c_start_rad = 0.9;
    scenario.plan.passes.push_back(pass);
  }
  ProbeStream stream = virtual_lathe::simulate(scenario);
  if (c.surface == "section") stream.position_mm.clear();
  return stream;
}

LawCase example(const std::string& surface) {
  LawCase c;
  c.surface = surface, c.radius_mm = 25.0, c.end_mm = surface == "section" ? 0.0 : 40.0;
  c.half_angle_deg = surface == "cone" ? 10.0 : 0.0;
  c.x_mm = 0.3, c.y_mm = -0.4;
  if (surface != "section") c.slope_x = 2e-3, c.slope_y = 1e-3;
  return c;
}

class ArcLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(ArcLaw, WithoutNoiseTheArcDeterminesTheSurface) {
  for (const double arc : {1.0, 5.0, 30.0}) {
    const LawCase c = example(GetParam());
    const FitResult result = fit(probe_arc(c, arc), options_of(c));
    SCOPED_TRACE(::testing::Message() << arc << "° " << to_literal(c));
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    const std::vector<double> expected = expected_parameters(c);
    const std::vector<double> tolerance = rounding_of_parameters(c, result);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(result.parameters[i].estimate.value, expected[i], tolerance[i]);
  }
}

TEST_P(ArcLaw, WithNoiseUCoversOrTheFitSaysSo) {
  for (const double arc : {1.0, 5.0, 10.0, 20.0, 30.0, 60.0, 120.0}) {
    for (const double noise : {0.001, 0.01, 0.05}) {
      constexpr int trials = 100;
      int stated = 0;
      std::vector<int> covered(expected_parameters(example(GetParam())).size(), 0);
      for (int trial = 0; trial < trials; ++trial) {
        LawCase c = example(GetParam());
        c.noise_mm = noise, c.seed = static_cast<std::uint64_t>(trial) + 1;
        const FitResult result = fit(probe_arc(c, arc), options_of(c));
        if (result.status == FitStatus::rank_deficient) continue;
        ASSERT_EQ(result.status, FitStatus::converged)
            << arc << "° " << to_literal(c) << ' ' << result.message;
        ++stated;
        const std::vector<double> expected = expected_parameters(c);
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const Estimate& e = result.parameters[i].estimate;
          if (std::abs(e.value - expected[i]) <= 2.0 * e.u) ++covered[i];
        }
      }
      // In noise of a 25 000th of the radius a third of a turn shows all of the surface.
      if (arc == 120.0 && noise == 0.001) {
        EXPECT_EQ(stated, trials);
      }
      for (std::size_t i = 0; i < covered.size(); ++i) {
        // Nominal 95.4 %; 5 binomial standard deviations of the trials that were stated.
        const double least = 0.954 * stated - 5.0 * std::sqrt(0.954 * 0.046 * stated);
        EXPECT_GE(covered[i], least)
            << arc << "° noise " << noise << " mm, parameter " << i << " of " << stated;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lateral, ArcLaw, ::testing::ValuesIn(lateral_ids()), name_of);

}  // namespace
}  // namespace trueaxis::laws
