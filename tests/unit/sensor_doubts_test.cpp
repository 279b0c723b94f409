// SPDX-License-Identifier: Apache-2.0
// Lobes of two and three undulations that both stand in phase with the eccentricity are what a
// function of the reading makes of it. No GO rests on which of the two it is.
#include <gtest/gtest.h>

#include <cmath>

#include "job/files/job_words.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

constexpr double tolerance_mm = 5e-3;

JobResult job_of_lobes(double eccentric_mm, double two_mm, double three_mm, double phase_rad) {
  virtual_lathe::Scenario scenario;
  scenario.seed = 3;
  scenario.part.kind = virtual_lathe::PartKind::cylinder;
  scenario.part.radius_mm = 20.0, scenario.part.x0_mm = eccentric_mm;
  scenario.noise.sigma_mm = 1e-3;
  virtual_lathe::PlannedPass pass;
  pass.end_mm = 55.0, pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = 36.0;
  scenario.plan.passes = {pass};
  scenario.effects = {
      {"part.roundness", {{"order", 3.0}, {"amplitude_mm", three_mm}, {"phase_rad", phase_rad}}},
      {"spindle.radial_synchronous",
       {{"order", 2.0}, {"amplitude_mm", two_mm}, {"phase_rad", phase_rad}}}};
  Job job;
  JobReference& reference = job.references.emplace_back();
  reference.name = "seat";
  reference.fit.surface = SurfaceKind::cylinder;
  job.target = TargetSurface{TargetKind::cylinder, false, 80.0, 60.0, 15.0, 0.0, 0.0, 0.0, 0.0};
  job.coaxiality_tolerance_mm = tolerance_mm;
  job.values_of_form = false;
  return run_job(job, {virtual_lathe::simulate(scenario)});
}

/// Twice the largest distance of the target axis from the true one, over the cut.
double coaxiality_mm_of(const JobResult& result, double eccentric_mm) {
  double off_mm = 0.0;
  for (const double z : {80.0, 60.0}) {
    const auto [x, y] = result.target_axis->axis.axis.at(z);
    off_mm = std::max(off_mm, std::hypot(x - eccentric_mm, y));
  }
  return 2.0 * off_mm;
}

TEST(SensorDoubts, LobesInPhaseWithTheEccentricityMakeNoWrongGo) {
  int cut = 0;
  for (const double eccentric_mm : {0.01, 0.03, 0.05, 0.1, 0.2})
    for (const auto& [two_mm, three_mm] : {std::pair{1e-3, 2e-3}, std::pair{2e-3, 2e-3},
                                           std::pair{0.3e-3, 0.3e-3}, std::pair{1e-3, 0.5e-3}}) {
      const JobResult result = job_of_lobes(eccentric_mm, two_mm, three_mm, 0.0);
      if (result.verdict.go()) {
        ++cut;
        EXPECT_LE(coaxiality_mm_of(result, eccentric_mm), tolerance_mm)
            << eccentric_mm << " " << two_mm << " " << three_mm << ": " << verdict_line(result);
      }
    }
  EXPECT_GT(cut, 0) << "the loop would hold nothing";
  const JobResult one = job_of_lobes(0.1, 2e-3, 2e-3, 0.0);  // for a sensor's error 6 µm off
  EXPECT_EQ(one.verdict.decision, Decision::not_proven) << verdict_line(one);
}

TEST(SensorDoubts, LobesElsewhereAreAGo) {
  const JobResult result = job_of_lobes(0.03, 1e-3, 2e-3, 0.7);
  EXPECT_TRUE(result.verdict.go()) << verdict_line(result);
  EXPECT_LE(coaxiality_mm_of(result, 0.03), tolerance_mm);
}

// 2 and 3 undulations of 2 µm with an eccentricity of 15 µm would be a sensor that errs by a
// quarter of its range. One would move the axis by 6 µm. The axis is known to better than 0.5.
TEST(SensorDoubts, ASensorDoesNotBendByAQuarterOfItsRange) {
  for (const double eccentric_mm : {0.015, 0.03}) {
    const JobResult result = job_of_lobes(eccentric_mm, 2e-3, 2e-3, 0.0);
    EXPECT_TRUE(result.verdict.go()) << verdict_line(result);
    EXPECT_LE(coaxiality_mm_of(result, eccentric_mm), 1e-3) << eccentric_mm;
  }
}

// Lobes of 2 and 3 undulations in phase with the eccentricity may be a sensor that bends by 2 to 8
// % of its range. The axis would then be 6 µm elsewhere. No reading tells them apart: the true axis
// is within U whatever the eccentricity.
TEST(SensorDoubts, TheAxisIsWithinUWhereASensorWouldBeElsewhere) {
  for (const double eccentric_mm : {0.1, 0.2, 0.3, 1.0}) {
    const JobResult result = job_of_lobes(eccentric_mm, 2e-3, 2e-3, 0.0);
    const FitResult& fit = result.diagnoses.front()->extended;
    for (const double z_mm : {fit.position_min_mm, fit.position_max_mm}) {
      const auto [x, y] = fit.axis.axis.at(z_mm);
      EXPECT_LE(std::hypot(x - eccentric_mm, y), 2.0 * fit.axis.u_at(z_mm)) << eccentric_mm;
    }
  }
}

}  // namespace
}  // namespace trueaxis
