// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <iostream>

#include "simulate/clean_stream.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

using namespace virtual_lathe;

constexpr std::uint64_t seed = 20261122;

/// A shaft probed on one side and then, taken out and turned, again; or in one set-up only.
Scenario shaft(PartKind kind, int set_ups, bool rear) {
  Scenario scenario;
  Part& part = scenario.part;
  part.kind = kind;
  part.x0_mm = 0.05, part.y0_mm = -0.03, part.l = 3e-4, part.m = -2e-4;
  part.radius_mm = 30.0, part.half_angle_rad = kind == PartKind::cone ? 0.2 : 0.0;
  part.d_mm = 2.0;
  PlannedPass pass;
  pass.start_mm = 10.0, pass.end_mm = 30.0;
  pass.feed_mm_per_rev = 0.5, pass.readings_per_revolution = 9.7;
  for (int number = 1; number <= set_ups; ++number) {
    pass.setup = number;
    scenario.plan.passes.push_back(pass);
    Chucking chucking;
    chucking.number = number;
    if (number > 1) chucking.reindex_rad = 1.2, chucking.x0_mm = 0.02;
    chucking.rear = rear;
    scenario.plan.setups.push_back(chucking);
  }
  scenario.noise.sigma_mm = 0.004;
  scenario.noise.outlier_fraction = 0.01, scenario.noise.outlier_size_mm = 0.1;
  return scenario;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void expect_same_fits(const Scenario& scenario, const FitOptions& options) {
  const CleanStream clean = simulate_clean(scenario);
  ProbeStream stream = clean.stream;
  RepeatedFit repeated(stream, options);
  for (std::uint64_t repeat = 0; repeat < 4; ++repeat) {
    draw_readings(clean, scenario.noise, seed + repeat, stream.reading_mm);
    const FitResult whole = fit(stream, options), again = repeated(stream.reading_mm);
    EXPECT_EQ(whole.status, FitStatus::converged);
    EXPECT_EQ(again.status, whole.status);
    EXPECT_TRUE(same_bits(again.residual_mm, whole.residual_mm));
    EXPECT_EQ(again.covariance, whole.covariance);
    for (std::size_t i = 0; i < whole.parameters.size(); ++i)
      EXPECT_EQ(again.parameters[i].estimate.value, whole.parameters[i].estimate.value);
  }
}

TEST(RepeatedFit, GivesTheBitsOfFit) {
  std::cout << "seed " << seed << '\n';
  for (const Loss loss : {Loss::plain, Loss::tukey}) {
    for (const bool rear : {false, true}) {
      for (const int set_ups : {1, 2}) {
        FitOptions options;
        options.loss = loss;
        options.surface = SurfaceKind::cone;
        expect_same_fits(shaft(PartKind::cone, set_ups, rear), options);
        options.surface = SurfaceKind::cylinder;
        expect_same_fits(shaft(PartKind::cylinder, set_ups, rear), options);
      }
    }
    FitOptions options;
    options.loss = loss;
    options.surface = SurfaceKind::plane;
    expect_same_fits(shaft(PartKind::face, 1, false), options);
  }
}

// The same stream as simulate(): the noise of the two generators differs, what is under it does
// not.
TEST(CleanStream, IsWhatTheLatheRecordsWithoutNoise) {
  Scenario scenario = shaft(PartKind::cone, 2, false);
  scenario.plan.passes[0].jitter = 0.3;
  scenario.effects.push_back({"part.roundness", {{"order", 3}, {"amplitude_mm", 0.004}}});
  const Simulation whole = simulate_with_truth(scenario);
  const CleanStream clean = simulate_clean(scenario);
  EXPECT_TRUE(same_bits(clean.value_mm, whole.truth.clean_mm));
  EXPECT_TRUE(same_bits(clean.stream.c_rad, whole.stream.c_rad));
  EXPECT_TRUE(same_bits(clean.stream.position_mm, whole.stream.position_mm));
  EXPECT_EQ(clean.stream.setup, whole.stream.setup);
  scenario.noise = {};
  std::vector<double> drawn(clean.value_mm.size());
  draw_readings(clean, scenario.noise, seed, drawn);
  EXPECT_TRUE(same_bits(drawn, simulate(scenario).reading_mm));
  EXPECT_TRUE(same_bits(clean.stream.reading_mm, drawn));
}

}  // namespace
}  // namespace trueaxis
