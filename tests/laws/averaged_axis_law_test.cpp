// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

double apart_mm(const FitResult& a, const FitResult& b) {
  double worst = 0.0;
  for (const double z : {a.position_min_mm, a.position_max_mm}) {
    const auto p = a.axis.axis.at(z), q = b.axis.axis.at(z);
    worst = std::max(worst, std::hypot(p[0] - q[0], p[1] - q[1]));
  }
  return worst;
}

// Two undulations of some tenths of a µm that grow along a small cylinder look like a probe that is
// millimetres off its height. The axis would then be tens of µm elsewhere.
TEST(AveragedAxis, FollowsNoCauseThatIsImplausiblyLarge) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Scenario s = probed_part(PartKind::cylinder);
    s.part.radius_mm = 17.0;
    s.part.x0_mm = 0.15, s.part.y0_mm = -0.1;
    s.noise.sigma_mm = 0.001;
    s.plan.passes[0].end_mm = 40.0;
    s.plan.passes[0].feed_mm_per_rev = 1.0;
    s.plan.passes[0].readings_per_revolution = 36.7;
    s.effects = {{"spindle.tilt_synchronous",
                  {{"order", 2.0},
                   {"amplitude_rad", 4e-6},
                   {"bearing_mm", -60.0},
                   {"phase_rad", 0.4 * static_cast<double>(seed)}}}};
    s.seed = seed;
    DiagnoseOptions options;
    options.fit.surface = SurfaceKind::cylinder;
    const Diagnosis d = diagnose(simulate(s), options);
    for (const Finding& finding : d.findings) EXPECT_NE(finding.effect(), "probe.height");
    // The ideal axis is off by thousandths of the ovality and by its noise. A height with a
    // probability of some thousandths keeps its share of U.
    EXPECT_LT(apart_mm(d.extended, d.baseline), 5e-4) << "seed " << seed;
    EXPECT_LT(d.extended.axis.u_at(0.0), 3e-3) << "seed " << seed;
  }
}

// One pass tells the height and the gain of the probe by nothing: what the catalogue calls typical
// of them widens U, unless the job states its own. A height h turns the eccentricity by h/R; it is
// there in a fifth of all streams, and its mean square is at least the square of the middle of its
// range, 0.05-1 mm: 0.2 · 0.05 mm² (e/R)².
TEST(AveragedAxis, HoldsWhatThePassDoesNotShowUnlessItIsStated) {
  Scenario s = probed_part(PartKind::cylinder);
  s.part.radius_mm = 17.0;
  s.part.x0_mm = 0.15, s.part.y0_mm = -0.1;
  s.noise.sigma_mm = 0.001;
  s.plan.passes[0].end_mm = 40.0;
  const ProbeStream stream = simulate(s);
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cylinder;
  const Diagnosis open = diagnose(stream, options);
  options.fit.influences = {{Influence::Kind::probe_height, 0.0},
                            {Influence::Kind::probe_gain, 0.0}};
  const Diagnosis stated = diagnose(stream, options);
  ASSERT_EQ(open.verdict, DiagnosisVerdict::ideal);
  EXPECT_LT(apart_mm(open.extended, open.baseline), 1e-9);  // the ideal fit stays
  const double u2 = std::pow(open.extended.axis.u_at(20.0), 2),
               u2_stated = std::pow(stated.extended.axis.u_at(20.0), 2);
  EXPECT_GT(u2 - u2_stated, 0.2 * 0.05 * std::pow(std::hypot(0.15, 0.1) / 17.0, 2));
  EXPECT_TRUE(std::ranges::any_of(
      open.shares, [](const AxisShare& share) { return share.effect == "probe.height"; }));
  EXPECT_TRUE(std::ranges::none_of(
      stated.shares, [](const AxisShare& share) { return share.effect == "probe.height"; }));
}

// After the last turn the part slips while the spindle is at rest: what is read then shows where it
// went along the probe line, not across. U is of the size of a slip there, not of the noise.
TEST(AveragedAxis, OfAPartThatSlippedUnderAStandingSpindleIsOpenAcrossTheProbeLine) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Scenario s = probed_part(PartKind::cylinder);
    s.noise.sigma_mm = 0.001;
    s.plan.passes[0].end_mm = 20.0;
    s.plan.passes[0].feed_mm_per_rev = 1.0;
    PlannedPass standing;
    standing.start_mm = standing.end_mm = 10.0;
    standing.speed_rpm = 0.0, standing.duration_s = 3.0, standing.rate_hz = 40.0;
    standing.c_start_rad = 0.7 * static_cast<double>(seed);
    s.plan.passes.push_back(standing);
    s.seed = seed;
    const double end_s = simulate(s).time_s.back();
    const double angle = 1.9 * static_cast<double>(seed), size_mm = 0.06;
    s.effects = {{"part.slip",
                  {{"time_s", end_s - 1.5},
                   {"dx_mm", size_mm * std::cos(angle)},
                   {"dy_mm", size_mm * std::sin(angle)},
                   {"turn_rad", 0.0}}}};
    DiagnoseOptions options;
    options.fit.surface = SurfaceKind::cylinder;
    const Diagnosis d = diagnose(simulate(s), options);
    ASSERT_NE(d.slip(), nullptr) << "seed " << seed;
    EXPECT_FALSE(d.slip()->parameter("dx").determined());
    const auto at = d.extended.axis.axis.at(10.0);
    const double true_x = s.part.x0_mm + 10.0 * s.part.l + size_mm * std::cos(angle),
                 true_y = s.part.y0_mm + 10.0 * s.part.m + size_mm * std::sin(angle);
    // Three u of an axis whose u is that of a slip: a normal law holds 99.7 %.
    EXPECT_LT(std::hypot(at[0] - true_x, at[1] - true_y), 3.0 * d.extended.axis.u_at(10.0));
    EXPECT_GT(d.extended.axis.u_at(10.0), 0.01) << "the least slip that is typical";
  }
}

// What the named model and the average have in common: one base, moved by what the shares say.
TEST(AveragedAxis, IsBetweenTheModelsItIsTheAverageOf) {
  Scenario s = probed_part(PartKind::cone);
  s.noise.sigma_mm = 0.002;
  s.effects = {{"part.roundness", {{"order", 2.0}, {"amplitude_mm", 0.004}, {"phase_rad", 1.0}}}};
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cone;
  const Diagnosis d = diagnose(simulate(s), options);
  ASSERT_FALSE(d.findings.empty());
  double most_mm = 0.0;
  for (const AxisShare& share : d.shares) {
    EXPECT_GT(share.probability, 0.0);
    EXPECT_LE(share.probability, 1.0);
    most_mm += share.probability * share.axis_shift.value;
  }
  // Shares below 1e-3 are not listed; sizes shrink by less than the noise of the axis.
  EXPECT_LE(apart_mm(d.extended, d.named), most_mm + d.named.axis.u_at(d.named.position_max_mm));
  EXPECT_GE(d.extended.axis.u_at(d.extended.position_min_mm),
            0.99 * d.named.axis.u_at(d.named.position_min_mm));
}

// Lobes of 50 µm that twist along the part are in no catalogue: by a tenth of their root mean
// square, 3.5 µm, each end of the axis is open (Eq. 95a); the patterns hold most of the form.
TEST(AveragedAxis, IsOpenByAShareOfWhatNoCauseExplains) {
  Scenario s = probed_part(PartKind::cylinder);
  s.noise.sigma_mm = 0.0005;
  s.effects = {{"extra.spiral",
                {{"order", 4.0}, {"amplitude_mm", 0.05}, {"lead_mm", 40.0}, {"phase_rad", 0.7}}}};
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cylinder;
  const Diagnosis d = diagnose(simulate(s), options);
  ASSERT_FALSE(d.unexplained.empty());
  const double open_mm = 0.1 * 0.05 / std::sqrt(2.0);
  for (const double z : {d.extended.position_min_mm, d.extended.position_max_mm}) {
    EXPECT_GT(d.extended.axis.u_at(z), 0.9 * open_mm);
    EXPECT_LT(d.named.axis.u_at(z), 0.3 * open_mm);
  }
}

// For a face the named model stays, and the rival causes of what was found are listed with what
// each would do: two undulations at one radius are the part's or the spindle's, the same column.
TEST(AveragedAxis, OfAFaceTheNamedModelStandsAndItsRivalsAreListed) {
  Scenario s = probed_part(PartKind::face);
  s.noise.sigma_mm = 0.001;
  s.effects = {
      {"spindle.axial_synchronous", {{"order", 3.0}, {"amplitude_mm", 0.01}, {"phase_rad", 0.4}}}};
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::plane;
  const Diagnosis d = diagnose(simulate(s), options);
  ASSERT_FALSE(d.findings.empty());
  ASSERT_FALSE(d.findings[0].rivals.empty());
  EXPECT_EQ(d.extended.axis.axis.slope_x, d.named.axis.axis.slope_x);
  EXPECT_EQ(d.extended.axis.axis.slope_y, d.named.axis.axis.slope_y);
  for (const Rival& rival : d.findings[0].rivals) {
    if (rival.probability < 0.01) continue;
    EXPECT_TRUE(std::ranges::any_of(d.shares, [&](const AxisShare& share) {
      return share.effect == rival.effect && share.instead_of == d.findings[0].effect();
    })) << rival.effect;
  }
}

// A narrow ring shows no axial motion once per revolution: a face with that motion reads as one
// that leans by a/R. It is there in a fifth of all faces, and its mean square is at least the
// square of the middle of its range, 0.5-10 µm.
TEST(AveragedAxis, OfAFaceHoldsWhatItsReadingsDoNotShow) {
  Scenario s = probed_part(PartKind::face);
  s.noise.sigma_mm = 0.001;
  PlannedPass& pass = s.plan.passes[0];
  pass.start_mm = 29.8, pass.end_mm = 30.2;
  pass.feed_mm_per_rev = 0.02;
  pass.readings_per_revolution = 24.3;
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::plane;
  const Diagnosis d = diagnose(simulate(s), options);
  const double open = std::sqrt(0.2 * 5e-4 * 0.01) / 30.0;
  EXPECT_GT(d.extended.axis.u_slopes(), 0.9 * open);
  EXPECT_LT(d.named.axis.u_slopes(), 0.1 * open);
}

}  // namespace
}  // namespace trueaxis::testing
