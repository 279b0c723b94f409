// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "diagnose/geometry/condense.hpp"
#include "support/diagnose_bench.hpp"
#include "support/diagnose_lathe.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

constexpr std::uint64_t seed = 6;
constexpr double sigma_mm = 5e-3;
const testing::HelixPlan dense{.readings = 40000, .per_turn = 333.3, .passes = 2};
const testing::HelixPlan sparse{.readings = 40000, .per_turn = 23.7, .passes = 2};

/// Two passes: out, and back faster.
struct Scene {
  LinearisationPoint point;
  ObservationMask mask = make_observation_mask(point);
  std::vector<double> deviation = testing::white_noise(point.size(), sigma_mm, seed);

  explicit Scene(const testing::HelixPlan& plan) : point(testing::bench_point(plan, 0.1)) {}
  Means means(std::vector<Hypothesis> known = {}, std::vector<double> linear = {}) const {
    return condense(point, mask, deviation, known, linear, false);
  }
  void add(const Hypothesis& h, const std::vector<double>& linear) {
    const std::vector<double> effect = contribution(point, {&h, 1}, linear);
    for (std::size_t i = 0; i < effect.size(); ++i) deviation[i] += effect[i];
  }
};

/// Amplitudes by least squares together with the base.
Eigen::VectorXd fitted(const LinearisationPoint& point, const ObservationMask& mask,
                       const std::vector<double>& y, const Hypothesis& h) {
  NormalEquations equations(point, mask, y, {}, 1);
  const Columns own = equations.append(std::vector<Hypothesis>{h})[0];
  Columns all = equations.base();
  all.insert(all.end(), own.begin(), own.end());
  return solve(equations.total(), all).coefficients.tail(static_cast<Eigen::Index>(own.size()));
}

class Condense : public ::testing::TestWithParam<testing::HelixPlan> {};

TEST_P(Condense, MeansAreOfTheSameSurfaceInFewTurns) {
  const Scene scene(GetParam());
  const Means means = scene.means();
  EXPECT_LT(means.point.size(), 21'000u);
  ASSERT_EQ(means.point.passes.size(), 2u);
  EXPECT_EQ(means.point.passes[0].end, means.point.passes[1].begin);
  EXPECT_EQ(means.mask.fold_begin.front(), 0u);
  EXPECT_EQ(means.mask.fold_begin.back(), means.point.size());
  // A mean is on the helix of its pass: Z follows C, as the part's own height does.
  const Pass& out = means.point.passes[0];
  const double lead = scene.point.z[39999] / scene.point.c[39999];
  for (std::size_t i = out.begin; i < out.end; ++i)
    ASSERT_NEAR(means.point.z[i], lead * means.point.c[i], 1e-9);
}

/// What is slow keeps its size: compared with the same term fitted to all readings, order 3 loses 1
/// − sinc(3/40) = 0.9 %. What the two fits see of the noise differs by the rest of the sector, √(1
/// − sinc²) = 0.13 of u = σ √(2/N).
TEST_P(Condense, WhatIsSlowKeepsItsSize) {
  std::cout << "seed " << seed << '\n';
  Scene scene(GetParam());
  const Hypothesis lobes = testing::roundness(3.0);
  scene.add(lobes, {2e-3, 1e-3});
  const Means means = scene.means();
  const Eigen::VectorXd whole = fitted(scene.point, scene.mask, scene.deviation, lobes);
  const Eigen::VectorXd part = fitted(means.point, means.mask, means.deviation_mm, lobes);
  const double u = sigma_mm * std::sqrt(2.0 / static_cast<double>(scene.point.size()));
  EXPECT_LT((part - whole).norm(), 0.010 * whole.norm() + 5.0 * 0.15 * u);
}

/// A line of which a mean keeps nothing is there as it is where it is known.
TEST_P(Condense, KnownLinesAreKept) {
  Scene scene(GetParam());
  Hypothesis line = of_effect("spindle.asynchronous", {.order = 1.37});
  scene.add(line, {2e-3, 1e-3});
  const Eigen::VectorXd whole = fitted(scene.point, scene.mask, scene.deviation, line);
  const Means blind = scene.means(), means = scene.means({line}, {whole(0), whole(1)});
  const Eigen::VectorXd part = fitted(means.point, means.mask, means.deviation_mm, line);
  // What the means add of the noise: their own projection on the line's columns, of u.
  const double u = sigma_mm * std::sqrt(2.0 / static_cast<double>(scene.point.size()));
  EXPECT_LT((part - whole).norm(), 5.0 * u);
  if (GetParam().per_turn < 40.0) {
    EXPECT_LT(fitted(blind.point, blind.mask, blind.deviation_mm, line).norm(),
              0.2 * whole.norm() + 5.0 * u);
  }
}

TEST_P(Condense, MaskedReadingsDoNotCount) {
  Scene scene(GetParam());
  for (std::size_t i = 800; i < 900; i += 2) scene.mask.mask(i), scene.deviation[i] = 1.0;
  scene.mask.find_runs(scene.point);
  const Means means = scene.means();
  for (std::size_t i = 0; i < means.point.size(); ++i)
    EXPECT_LT(std::abs(means.deviation_mm[i]), 6.0 * sigma_mm);
}

/// Lines between whole orders are lost where several turns are averaged, those near them are not.
TEST_P(Condense, SaysWhichLinesItKeeps) {
  const Scene scene(GetParam());
  const Means means = scene.means();
  const Extent within{0.35 / two_pi, 11.0 / two_pi};
  const std::vector<Extent> kept = means.kept(scene.point, &PointPart::c, 0.0, within);
  const auto keeps = [&](double order) {
    return std::ranges::any_of(
        kept, [&](const Extent& e) { return e.low <= order / two_pi && order / two_pi <= e.high; });
  };
  EXPECT_TRUE(keeps(3.0));
  EXPECT_TRUE(keeps(3.001));
  EXPECT_EQ(keeps(3.4), GetParam().per_turn > 40.0);  // its means are of one turn
}

INSTANTIATE_TEST_SUITE_P(Densities, Condense, ::testing::Values(dense, sparse),
                         [](const auto& info) {
                           return info.param.per_turn > 40.0 ? "dense" : "sparse";
                         });

TEST(CondenseSize, OnlyLongStreams) {
  EXPECT_FALSE(is_condensed(testing::bench_point({.readings = 39000}, 0.1)));
  EXPECT_TRUE(is_condensed(testing::bench_point({.readings = 40000}, 0.1)));
}

struct LineCase {
  const char* id;
  double per_turn;
};
void PrintTo(const LineCase& c, std::ostream* out) { *out << c.id << " at " << c.per_turn; }

/// λ = N A²/(2σ²) = 170 either way (threshold 28): what is slow is found in the means, what is
/// faster than they are in all readings; the same on one thread and on three.
class LongStream : public ::testing::TestWithParam<LineCase> {};

TEST_P(LongStream, ItsLineIsFound) {
  std::cout << "seed " << seed << '\n';
  const std::string id = GetParam().id;
  const double per_turn = GetParam().per_turn, turns = 66'660.0 / per_turn;
  virtual_lathe::Scenario scenario = testing::one_pass(0.1, turns, sigma_mm);
  scenario.seed = seed;
  scenario.plan.passes[0].readings_per_revolution = per_turn;
  scenario.plan.passes[0].speed_rpm = 600.0;
  const double amplitude_mm = sigma_mm * std::sqrt(2.0 * 170.0 / (turns * per_turn));
  const double frequency_hz = per_turn > 40.0 ? 312.7 : 37.7;
  if (id == "part.roundness")
    scenario.effects = {{id, {{"order", 3.0}, {"amplitude_mm", amplitude_mm}, {"phase_rad", 0.7}}}};
  else
    scenario.effects = {
        {id, {{"frequency_hz", frequency_hz}, {"amplitude_mm", amplitude_mm}, {"phase_rad", 0.7}}}};
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  DiagnoseOptions options = testing::on_one_core(scenario);
  const Diagnosis found = diagnose(stream, options);
  ASSERT_EQ(found.findings.size(), 1u);
  const Finding* f = testing::finding_with(found, id);
  ASSERT_NE(f, nullptr);
  const Estimate* amplitude = testing::parameter_of(*f, "amplitude");
  ASSERT_NE(amplitude, nullptr);
  EXPECT_NEAR(amplitude->value, amplitude_mm, 4.0 * amplitude->u);
  options.threads = 3;
  const Diagnosis again = diagnose(stream, options);
  EXPECT_EQ(again.residual_after_mm, found.residual_after_mm);
  EXPECT_EQ(again.effect_mm, found.effect_mm);
  EXPECT_EQ(again.findings[0].axis_shift.value, found.findings[0].axis_shift.value);
}

INSTANTIATE_TEST_SUITE_P(Lines, LongStream,
                         ::testing::Values(LineCase{"part.roundness", 333.3},
                                           LineCase{"environment.vibration", 333.3},
                                           LineCase{"part.roundness", 23.7},
                                           LineCase{"environment.vibration", 23.7}));

}  // namespace
}  // namespace trueaxis
