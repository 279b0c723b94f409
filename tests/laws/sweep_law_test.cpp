// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iostream>
#include <set>

#include "support/sweep_examples.hpp"
#include "trueaxis/base/units.hpp"
#include "trueaxis/simulate/clean_stream.hpp"
#include "trueaxis/study/quantities.hpp"
#include "trueaxis/study/scenario_parameters.hpp"

/// What must hold of any sweep.
namespace trueaxis::study {
namespace {

using namespace virtual_lathe;
using testing::over;
using testing::probed_part;
using testing::run_all;

constexpr std::uint64_t seed = 20261121;
constexpr double level = 0.01;  // chance that an efficient engine fails a test, over all its cells

Sweep sweep_of(PartKind kind, std::vector<GridAxis> axes, std::size_t repeats) {
  Sweep sweep;
  sweep.base = probed_part(kind);
  sweep.axes = std::move(axes);
  sweep.repeats = repeats;
  sweep.seed = seed;
  return sweep;
}

/// RMSE over the bound within χ², coverage of U (k = 2) within the binomial of Student's t; each
/// cell at level / tests.
void expect_efficient(const Sweep& sweep, double tests) {
  const Summary summary = summarise(sweep, run_all(sweep, 0));
  const double tail = 0.5 * level / tests, n = static_cast<double>(sweep.repeats);
  const boost::math::chi_squared square(n);
  const double lowest = std::sqrt(quantile(square, tail) / n);
  const double highest = std::sqrt(quantile(complement(square, tail)) / n);
  for (const Row& row : summary.rows) {
    const std::string where = surface_of(sweep.base.part.kind) +
                              (" cell " + std::to_string(row.cell)) + " " + row.quantity;
    ASSERT_EQ(row.estimates, sweep.repeats) << where;
    ASSERT_TRUE(std::isfinite(row.ratio)) << where;
    EXPECT_GE(row.ratio, lowest) << where;
    EXPECT_LE(row.ratio, highest) << where;
    const double freedom = static_cast<double>(summary.cells[row.cell].readings) - 6.0;
    const double inside = 1.0 - 2.0 * cdf(complement(boost::math::students_t(freedom), 2.0));
    const boost::math::binomial hits(n, inside);
    EXPECT_GE(row.coverage * n, quantile(hits, tail) - 1.0) << where;
    EXPECT_LE(row.coverage * n, quantile(complement(hits, tail)) + 1.0) << where;
  }
}

TEST(Sweep, FitsReachTheBoundAndTheirUCovers) {
  std::cout << "seed " << seed << '\n';
  const std::vector<GridAxis> axes{over("pass.length_mm", {15.0, 30.0}),
                                   over("noise.sigma_mm", {0.001, 0.01}),
                                   over("part.x0_mm", {0.0, 0.4})};
  const double cells = 8.0, tests = 2.0 * cells * (11.0 + 9.0 + 3.0);
  expect_efficient(sweep_of(PartKind::cone, axes, 1500), tests);
  expect_efficient(sweep_of(PartKind::cylinder, axes, 1500), tests);
  std::vector<GridAxis> of_face = axes;
  of_face.pop_back();
  expect_efficient(sweep_of(PartKind::face, of_face, 1500), tests);
}

TEST(Bound, KnowsTheKindOfNoise) {
  const auto sd = [](auto change) {
    Scenario scenario = probed_part(PartKind::cone);
    change(scenario.noise);
    return bound_of(scenario).sd;
  };
  const std::vector<double> white = sd([](Noise&) {});
  const auto ratio = [&](const std::vector<double>& of, std::size_t i) { return of[i] / white[i]; };
  const std::vector<double> twice = sd([](Noise& noise) { noise.sigma_mm *= 2.0; });
  const std::vector<double> student = sd([](Noise& noise) { noise.student_dof = 3.0; });
  const std::vector<double> uniform = sd([](Noise& noise) {
    noise.uniform_mm = std::sqrt(3.0) * noise.sigma_mm;
    noise.sigma_mm = 0.0;
  });
  const std::vector<double> both =
      sd([](Noise& noise) { noise.uniform_mm = std::sqrt(3.0) * noise.sigma_mm; });
  for (std::size_t i = 0; i < white.size(); ++i) {
    EXPECT_NEAR(ratio(twice, i), 2.0, 1e-9) << i;
    // Fisher information of t with ν: (ν + 1)/(ν + 3) over scale²; scale² = σ² (ν − 2)/ν.
    EXPECT_NEAR(ratio(student, i), std::sqrt((1.0 / 3.0) * (6.0 / 4.0)), 1e-9) << i;
    EXPECT_NEAR(ratio(uniform, i), 1.0, 1e-9) << i;  // the same variance, Gauss-Markov
    EXPECT_NEAR(ratio(both, i), std::sqrt(2.0), 1e-9) << i;
  }
}

// AR(1) and a white part against the covariance matrix written out and inverted.
TEST(Bound, WhitensAsTheInverseCovarianceDoes) {
  Scenario scenario = probed_part(PartKind::face);
  scenario.part.l = scenario.part.m = 0.0;
  scenario.plan.passes[0].end_mm = 20.0;
  scenario.noise.rho = 0.7;
  scenario.noise.uniform_mm = 0.004;
  const CleanStream clean = simulate_clean(scenario);
  const auto n = static_cast<Eigen::Index>(clean.value_mm.size());
  Eigen::MatrixXd jacobian(n, 3), covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {  // z = d − l x − m y to first order
    const double x = clean.stream.position_mm[static_cast<std::size_t>(i)];
    const double c = clean.stream.c_rad[static_cast<std::size_t>(i)];
    jacobian.row(i) << -x * std::cos(c), -x * std::sin(c), 1.0;
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) = 25e-6 * std::pow(0.7, std::abs(static_cast<double>(i - j)));
    covariance(i, i) += 16e-6 / 3.0;
  }
  const Eigen::MatrixXd information = jacobian.transpose() * covariance.ldlt().solve(jacobian);
  const Eigen::VectorXd expected = information.inverse().diagonal().cwiseSqrt();
  const Bound bound = bound_of(scenario);
  EXPECT_EQ(bound.kind, Bound::Kind::gauss_markov);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(bound.sd[i] / expected(static_cast<Eigen::Index>(i)), 1.0, 1e-7) << i;
}

TEST(Bound, IsNotThereWhereTheReadingsDoNotDetermineTheParameters) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.part.l = scenario.part.m = 0.0;
  scenario.plan.passes[0].end_mm = scenario.plan.passes[0].start_mm;  // one section: no tilt
  scenario.plan.passes[0].revolutions = 20.0;
  for (const double sd : bound_of(scenario).sd) EXPECT_TRUE(std::isnan(sd));
}

TEST(Sweep, OrderOfWorkDoesNotShow) {
  Sweep sweep = sweep_of(PartKind::cylinder, {over("noise.sigma_mm", {0.002, 0.01})}, 130);
  sweep.methods = {Method::fit, Method::tukey};
  sweep.drawn = {{"part.x0_mm", "part.x0_mm", Drawn::Kind::uniform, -0.2, 0.2}};
  const std::vector<BlockResult> whole = run_all(sweep, 2);
  for (const BlockResult& result : whole) {
    BlockResult alone = run_block(sweep, result.block);
    alone.seconds = result.seconds;
    EXPECT_EQ(encode(alone), encode(result));
    const BlockResult back = decode(encode(result));
    EXPECT_EQ(encode(back), encode(result));
  }
}

TEST(Sweep, MethodsSeeTheSameReadingsAndRepeatsOthers) {
  Sweep sweep = sweep_of(PartKind::cone, {over("noise.sigma_mm", {0.002, 0.01})}, 1000);
  sweep.methods = {Method::fit, Method::huber};
  std::set<std::uint64_t> seeds;
  for (std::size_t cell = 0; cell < cell_count(sweep); ++cell) {
    for (std::size_t repeat = 0; repeat < sweep.repeats; ++repeat)
      seeds.insert(seed_of(sweep, cell, repeat));
  }
  EXPECT_EQ(seeds.size(), 2 * sweep.repeats);  // two grid points
  EXPECT_EQ(seed_of(sweep, 0, 7), seed_of(sweep, 1, 7));
  EXPECT_NE(seed_of(sweep, 0, 7), seed_of(sweep, 2, 7));
}

// Every number that a scenario has can be set and read back, and only the paths asked for move.
TEST(ScenarioParameters, AreSetOneByOne) {
  for (const PartKind kind : {PartKind::cone, PartKind::cylinder, PartKind::face}) {
    Scenario scenario = probed_part(kind);
    scenario.effects.push_back({"part.roundness", {{"order", 3}, {"amplitude_mm", 0.004}}});
    scenario.plan.passes.push_back(scenario.plan.passes.front());
    for (const ScenarioParameter& known : scenario_parameters(scenario)) {
      Scenario changed = scenario;
      const double value = std::isinf(known.low) || known.low < 0.0 ? 0.37 : known.low + 0.37;
      set_parameter(changed, known.path, value);
      EXPECT_NEAR(parameter(changed, known.path), value, 1e-12) << known.path;
    }
  }
  Scenario scenario = probed_part(PartKind::cone);
  scenario.plan.passes.front().end_mm = -5.0;  // towards −Z
  set_parameter(scenario, "pass.length_mm", 20.0);
  EXPECT_EQ(scenario.plan.passes.front().end_mm, -10.0);
}

// Truth by hand: a cone given by a radius has its apex where the radius would be 0.
TEST(Quantities, AreThoseOfThePart) {
  Scenario scenario = probed_part(PartKind::cone);
  scenario.part.apex_mm.reset();
  scenario.part.radius_mm = 30.0, scenario.part.radius_at_mm = 10.0;
  scenario.part.half_angle_rad = -0.1;  // falls with Z: the apex lies beyond
  const std::vector<double> truth = true_values(scenario, {10.0, 40.0});
  EXPECT_NEAR(truth[4], 10.0 + 30.0 / std::tan(0.1), 1e-9);
  EXPECT_NEAR(truth[5], 0.1 / rad_per_deg, 1e-12);
  const double n = std::sqrt(1.0 - 4e-4 * 4e-4 - 7e-4 * 7e-4);
  EXPECT_NEAR(truth[8], 0.08 + 40.0 * 4e-4 / n, 1e-12);
  EXPECT_NEAR(truth[9], -0.05 - 40.0 * 7e-4 / n, 1e-12);
}

}  // namespace
}  // namespace trueaxis::study
