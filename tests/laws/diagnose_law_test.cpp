// SPDX-License-Identifier: Apache-2.0
// Over the catalogue: what is large enough to be seen is found and its cause is in the class; what is
// not there is not found, and then the axis stays.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <iostream>

#include "diagnose/extended.hpp"
#include "laws/lathe_cases.hpp"
#include "support/diagnose_bench.hpp"
#include "support/diagnose_lathe.hpp"

namespace trueaxis::testing {
namespace {

constexpr double sigma_mm = 0.5e-3;
constexpr std::uint64_t seed = 12;

/// Every kind of pass of effects.md's plan P8, in a few hundred readings: out, back at a second
/// speed, reversed, a dwell, a stationary capture, from the rear, and clamped anew turned by 70° with
/// less force and a jog of X.
virtual_lathe::Scenario all_passes(double tangent) {
  virtual_lathe::Scenario scenario = one_pass(tangent, 7.3, 0.0);
  virtual_lathe::PlannedPass out = scenario.plan.passes[0], back = out, reversed = out, dwell = out,
                             still = out, rear = out, again = out;
  for (virtual_lathe::PlannedPass* p : {&out, &back, &reversed, &dwell, &still, &rear, &again})
    p->pause_s = 2.3;
  back.start_mm = 60.0, back.end_mm = 0.0, back.speed_rpm = 151.0;
  reversed.speed_rpm = -60.0;
  dwell.start_mm = dwell.end_mm = 30.0, dwell.revolutions = 5.0;
  still.start_mm = still.end_mm = 30.0, still.speed_rpm = 0.0;
  still.duration_s = 8.0, still.rate_hz = 11.3;
  rear.setup = 2, rear.start_mm = 60.0, rear.end_mm = 0.0;
  again.setup = 3;
  virtual_lathe::Chucking second, third;
  second.number = 2, second.rear = true;
  third.number = 3, third.reindex_rad = 70.0 * rad_per_deg, third.clamp_force_ratio = 0.5;
  third.x_jog_mm = 0.1;
  third.x0_mm = -0.1, third.y0_mm = 0.15, third.l = -7e-4, third.m = 5e-4;
  scenario.plan.passes = {out, back, reversed, dwell, still, rear, again};
  scenario.plan.setups = {second, third};
  return scenario;
}

Eigen::VectorXd clean(const virtual_lathe::Scenario& scenario) {
  return as_vector(virtual_lathe::simulate_with_truth(scenario).truth.clean_mm);
}

/// What the surface of all set-ups takes, from a fit of the noise-free readings.
Eigen::MatrixXd surface_columns(const virtual_lathe::Scenario& scenario) {
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  const FitResult ideal = fit(stream, on_one_core(scenario).fit);
  const auto clampings = diagnose_detail::clampings_of(ideal, 0.0);
  return explicit_columns(
      diagnose_detail::make_scene(stream, clampings,
                                  diagnose_detail::base_of(stream, ideal, clampings), false),
      {});
}

struct Bench {
  virtual_lathe::Scenario plain;
  Eigen::MatrixXd surface;
  Eigen::VectorXd ideal;

  explicit Bench(double tangent)
      : plain(all_passes(tangent)), surface(surface_columns(plain)), ideal(clean(plain)) {}
  double left_of(const Eigen::VectorXd& change) const {
    return std::sqrt(explicit_rss(surface, change));
  }
};

std::string classes_of(const Diagnosis& d) {
  std::string text;
  for (const Finding& f : d.findings) {
    text += '[';
    for (const std::string& id : f.members) text += ' ' + id;
    text += " ]";
  }
  for (const Unexplained& u : d.unexplained) text += '<' + u.harmonic + ' ' + u.dependence + '>';
  return text;
}

class EveryEffect : public ::testing::TestWithParam<LatheCase> {};

/// A statistic of 28 is found with power one half (effects.md); twenty times that size.
constexpr double detectable_left = 5.3, times = 20.0;
/// Of a case's own small size: beyond that it is absorbed by the surface for every purpose.
constexpr double largest = 60.0;

TEST_P(EveryEffect, IsFoundWithItsCauseInTheClass) {
  std::cout << "seed " << seed << '\n';
  static const Bench bench(0.1);
  const LatheCase& c = GetParam();
  virtual_lathe::Scenario scenario = bench.plain;
  scenario.effects = {{c.id, c.lathe(c.size)}};
  const double left = bench.left_of(clean(scenario) - bench.ideal) / sigma_mm;
  const double size = c.size * times * detectable_left / left;
  std::cout << c.id << ": size " << size << ", " << size / c.size << " of the case's\n";
  if (!(size < largest * c.size)) GTEST_SKIP() << c.id << " is absorbed by the surface";
  scenario.effects = {{c.id, c.lathe(size)}};
  scenario.noise.sigma_mm = sigma_mm;
  scenario.seed = seed;
  const Diagnosis found = diagnose(virtual_lathe::simulate(scenario), on_one_core(scenario));
  std::cout << classes_of(found) << '\n';
  EXPECT_NE(finding_with(found, c.id), nullptr) << classes_of(found);
}

std::string case_name(const ::testing::TestParamInfo<LatheCase>& info) {
  std::string name = info.param.id + "_" + std::to_string(info.index);
  std::ranges::replace(name, '.', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, ::testing::ValuesIn(lathe_cases()), case_name);

// Nothing hidden: nothing is found, and the extended model is the baseline, the same fit of the same
// readings: equal to the last digits that its convergence leaves.
TEST(NothingHidden, NothingFoundAndTheAxisStays) {
  std::cout << "seed " << seed << '\n';
  for (const double tangent : {0.0, 0.1}) {
    for (virtual_lathe::Scenario scenario : {all_passes(tangent), one_pass(tangent, 30.0, 0.0)}) {
      scenario.noise.sigma_mm = sigma_mm;
      scenario.seed = seed;
      const Diagnosis found = diagnose(virtual_lathe::simulate(scenario), on_one_core(scenario));
      EXPECT_EQ(found.verdict, DiagnosisVerdict::ideal) << classes_of(found);
      for (const double z_mm : {0.0, 60.0}) {
        const auto before = found.baseline.axis.axis.at(z_mm);
        const auto after = found.extended.axis.axis.at(z_mm);
        EXPECT_NEAR(before[0], after[0], 1e-9);
        EXPECT_NEAR(before[1], after[1], 1e-9);
      }
      EXPECT_EQ(found.gain.axis_shift.value, 0.0);
      EXPECT_EQ(found.gain.rms_before_mm, found.gain.rms_after_mm);
      for (std::size_t i = 0; i < found.residual_after_mm.size(); i += 29)
        EXPECT_NEAR(found.residual_after_mm[i], found.residual_before_mm[i], 1e-7);
      for (const double v : found.effect_mm) EXPECT_EQ(v, 0.0);
    }
  }
}

}  // namespace
}  // namespace trueaxis::testing
