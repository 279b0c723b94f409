// SPDX-License-Identifier: Apache-2.0
// Law: the set-ups of a stream are one part. Every clamping has its axis, all share the shape.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/set_up_bench.hpp"
#include "support/dense.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::laws {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double known_noise_mm = 1e-6;  // makes u / known_noise the √ of the diagonal of (JᵀJ)⁻¹

FitOptions options_for(const std::string& surface) {
  FitOptions options;
  options.surface = surface_from_id(surface);
  return options;
}

/// How far rounding of N readings can move a parameter: ‖δ‖ √(JᵀJ)⁻¹ᵢᵢ, |δ| ≤ 4 ε of the largest
/// coordinate a reading meets.
double rounding_of(const FitParameter& parameter, std::size_t n, double size_mm) {
  return std::sqrt(static_cast<double>(n)) * 4.0 * epsilon * size_mm * parameter.estimate.u /
             known_noise_mm +
         64.0 * epsilon * std::abs(parameter.estimate.value);
}

void expect_recovered(const SetUpBench& bench, const FitResult& result) {
  ASSERT_EQ(result.status, FitStatus::converged) << result.message;
  ASSERT_EQ(result.set_ups.size(), bench.scenario.plan.setups.size());
  for (std::size_t s = 0; s < result.set_ups.size(); ++s) {
    SCOPED_TRACE("set-up " + std::to_string(s + 1));
    const SetUpFit& one = result.set_ups[s];
    const virtual_lathe::Chucking& chucking = bench.scenario.plan.setups[s];
    EXPECT_EQ(one.set_up.number, chucking.number);
    EXPECT_EQ(one.side, chucking.rear ? Root::rear : Root::front);
    const std::vector<double> expected = bench.expected(chucking);
    ASSERT_EQ(one.parameters.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(one.parameters[i].estimate.value, expected[i],
                  rounding_of(one.parameters[i], result.points, 200.0))
          << one.parameters[i].name;
    }
    EXPECT_NEAR(one.axis.axis.at(0.0)[0], expected[0], 1e-9);
    EXPECT_NEAR(one.axis.axis.at(0.0)[1], expected[1], 1e-9);
  }
  const SetUpFit& last = result.set_ups.back();
  EXPECT_EQ(result.axis.axis.x_mm, last.axis.axis.x_mm);
  EXPECT_EQ(result.axis.covariance, last.axis.covariance);
  EXPECT_EQ(result.shape.radius_mm, last.shape.radius_mm);
  EXPECT_EQ(result.parameters[0].estimate.value, last.parameters[0].estimate.value);
}

class SetUpLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(SetUpLaw, RecoversEveryAxisAndTheSharedShape) {
  constexpr std::uint64_t seed = 31001;
  Draw draw(seed);
  for (int i = 0; i < 100; ++i) {
    const SetUpBench bench = draw_bench(GetParam(), draw, i % 2 == 0 ? 2 : 3);
    SCOPED_TRACE("seed 31001, case " + std::to_string(i));
    FitOptions options = options_for(GetParam());
    options.noise_mm = known_noise_mm;
    expect_recovered(bench, fit(virtual_lathe::simulate(bench.scenario), options));
    if (HasFailure()) break;
  }
}

TEST_P(SetUpLaw, OrderOfTheReadingsDoesNotMatter) {
  Draw draw(31002);
  const SetUpBench bench = draw_bench(GetParam(), draw, 3);
  const ProbeStream stream = virtual_lathe::simulate(bench.scenario);
  ProbeStream shuffled = stream;
  for (std::size_t i = 0; i < stream.size(); ++i) {  // every seventh reading in turn
    const std::size_t n = stream.size(), from = (i * 7919) % n;
    ASSERT_NE(n % 7919, 0u);
    shuffled.reading_mm[i] = stream.reading_mm[from], shuffled.c_rad[i] = stream.c_rad[from];
    shuffled.position_mm[i] = stream.position_mm[from], shuffled.setup[i] = stream.setup[from];
  }
  FitOptions options = options_for(GetParam());
  options.noise_mm = known_noise_mm;
  expect_recovered(bench, fit(shuffled, options));
}

/// σ² (JᵀJ)⁻¹ with J by differences of the lathe's readings: the smallest covariance of an unbiased
/// estimate of x0, y0, l, m of every clamping and the two (cylinder: one) of the shape.
Eigen::MatrixXd cramer_rao(const SetUpBench& bench, double sigma_mm) {
  constexpr double step = 1e-4;  // error of the difference: its square
  const auto readings = [&](std::size_t parameter, double by) {
    SetUpBench moved = bench;
    moved.scenario.noise = {};
    moved.nudge(parameter, by);
    return virtual_lathe::simulate(moved.scenario).reading_mm;
  };
  const std::size_t p = bench.parameter_count();
  const auto n = static_cast<Eigen::Index>(readings(0, 0.0).size());
  Eigen::MatrixXd jacobian(n, static_cast<Eigen::Index>(p));
  for (std::size_t i = 0; i < p; ++i) {
    const std::vector<double> up = readings(i, step), down = readings(i, -step);
    for (Eigen::Index row = 0; row < n; ++row) {
      const auto at = static_cast<std::size_t>(row);
      jacobian(row, static_cast<Eigen::Index>(i)) = (up[at] - down[at]) / (2.0 * step);
    }
  }
  return sigma_mm * sigma_mm * dense::inverse(jacobian.transpose() * jacobian);
}

TEST_P(SetUpLaw, UncertaintyIsTheCramerRaoBoundAndCovers) {
  constexpr std::uint64_t seed = 31003;
  constexpr int trials = 200;
  constexpr double sigma_mm = 0.002;
  SetUpBench bench = fixed_bench(GetParam());
  bench.scenario.noise.sigma_mm = sigma_mm;
  bench.scenario.probe.states_noise = false;
  const Eigen::MatrixXd bound = cramer_rao(bench, sigma_mm);
  const std::size_t shapes = bench.shape_count(), axes = bench.scenario.plan.setups.size();
  std::vector<int> covered(4 * axes + shapes, 0);
  std::vector<double> sum(covered.size(), 0.0), sum2(covered.size(), 0.0);
  for (int trial = 0; trial < trials; ++trial) {
    bench.scenario.seed = seed + static_cast<std::uint64_t>(trial);
    SCOPED_TRACE("seed " + std::to_string(bench.scenario.seed));
    const FitResult result = fit(virtual_lathe::simulate(bench.scenario), options_for(GetParam()));
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    for (std::size_t j = 0; j < covered.size(); ++j) {
      // x0, y0, l, m of each set-up; the shape as the first one (without shift) shows it.
      const std::size_t s = j < 4 * axes ? j / 4 : 0, i = j < 4 * axes ? j % 4 : 4 + j - 4 * axes;
      const Estimate& estimate = result.set_ups[s].parameters[i].estimate;
      const double error = estimate.value - bench.expected(bench.scenario.plan.setups[s])[i];
      covered[j] += std::abs(error) <= 2.0 * estimate.u ? 1 : 0;
      sum[j] += error, sum2[j] += error * error;
      if (trial == 0) {
        const auto row = static_cast<Eigen::Index>(j);
        // x0, y0 of a shifted set-up are read at Z = 0, not at the shift: no bound of their own.
        if (i >= 2 || bench.scenario.plan.setups[s].z_shift_mm == 0.0) {
          EXPECT_NEAR(estimate.u / (result.sigma_mm * result.widened) * sigma_mm,
                      std::sqrt(bound(row, row)), 1e-3 * estimate.u)
              << "parameter " << j;
        }
      }
    }
    for (const SetUpFit& one : result.set_ups) {
      EXPECT_EQ(one.parameters.back().estimate.value,
                result.parameters.back().estimate.value);  // half angle, radius: one number
    }
  }
  for (std::size_t j = 0; j < covered.size(); ++j) {
    SCOPED_TRACE("parameter " + std::to_string(j));
    // 2 u hold 95.4 % of a normal error; 4 σ of a binomial of 200.
    EXPECT_NEAR(covered[j] / static_cast<double>(trials), 0.9545,
                4.0 * std::sqrt(0.9545 * 0.0455 / trials));
    const std::size_t s = j < 4 * axes ? j / 4 : 0;
    if (j < 4 * axes && j % 4 < 2 && bench.scenario.plan.setups[s].z_shift_mm != 0.0) continue;
    const auto row = static_cast<Eigen::Index>(j);
    const double u = std::sqrt(bound(row, row));
    EXPECT_NEAR(sum[j] / trials, 0.0, 4.0 * u / std::sqrt(trials));
    // The variance of 200 normal errors is χ² of 200: relative standard deviation √(2/200) = 0.1.
    EXPECT_NEAR(std::sqrt(sum2[j] / trials) / u, 1.0, 4.0 * 0.05);
  }
}

TEST_P(SetUpLaw, TwoSetUpsTellTheShapeBetterThanOne) {
  SetUpBench bench = fixed_bench(GetParam());
  bench.scenario.noise.sigma_mm = 0.002;
  const ProbeStream both = virtual_lathe::simulate(bench.scenario);
  ProbeStream first = both;
  const auto n = static_cast<std::size_t>(std::ranges::count(both.setup, 1));
  for (auto* column : {&first.reading_mm, &first.c_rad, &first.position_mm, &first.time_s})
    column->resize(n);
  first.pass.resize(n), first.setup.resize(n);
  const FitOptions options = options_for(GetParam());
  const double u_both = fit(both, options).parameters.back().estimate.u;
  const double u_first = fit(first, options).parameters.back().estimate.u;
  EXPECT_LT(u_both, 0.8 * u_first);  // twice the readings or more: 0.71 of it and less
}

TEST_P(SetUpLaw, RobustLossesTakeOneScaleForAll) {
  for (const Loss loss : {Loss::huber, Loss::tukey}) {
    SCOPED_TRACE(to_string(loss));
    SetUpBench bench = fixed_bench(GetParam());
    bench.scenario.noise.sigma_mm = 0.001;
    bench.scenario.noise.outlier_fraction = 0.05;
    bench.scenario.noise.outlier_size_mm = 0.2;
    bench.scenario.seed = 31004;
    const auto simulation = virtual_lathe::simulate_with_truth(bench.scenario);
    FitOptions options = options_for(GetParam());
    options.loss = loss;
    const FitResult result = fit(simulation.stream, options);
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    // MAD of normal residuals: efficiency 37 %, so its relative sd is √(1/(2 · 0.37 N)); Huber's
    // scale also sees 5 % of outliers, which widen it by 6 %.
    const auto n = static_cast<double>(result.points);
    EXPECT_NEAR(result.sigma_mm, 0.001, 0.001 * (4.0 / std::sqrt(0.74 * n) + 0.08));
    std::vector<std::size_t> rejected;
    for (const Rejected& r : result.rejected) rejected.push_back(r.row - 1);
    for (const std::size_t row : simulation.truth.outlier_rows)
      EXPECT_TRUE(std::ranges::binary_search(rejected, row)) << row;
    for (std::size_t s = 0; s < result.set_ups.size(); ++s) {
      const std::vector<double> expected = bench.expected(bench.scenario.plan.setups[s]);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const Estimate& e = result.set_ups[s].parameters[i].estimate;
        EXPECT_NEAR(e.value, expected[i], 4.5 * e.u) << result.set_ups[s].parameters[i].name;
      }
    }
  }
}

TEST_P(SetUpLaw, OneSectionBorrowsNoAxis) {
  SetUpBench bench = fixed_bench(GetParam());
  virtual_lathe::Plan& plan = bench.scenario.plan;
  plan.setups.resize(2);
  plan.setups[1].rear = false;
  plan.setups[1].l = plan.setups[1].m = 0.0;
  plan.passes.resize(2);
  plan.passes[1].start_mm = plan.passes[1].end_mm = 42.0;
  plan.passes[1].revolutions = 20.0;
  bench.scenario.noise.sigma_mm = 0.002;
  const FitResult result = fit(virtual_lathe::simulate(bench.scenario), options_for(GetParam()));
  EXPECT_EQ(result.status, FitStatus::rank_deficient);
  ASSERT_FALSE(result.not_determined.empty());
  for (const std::string& what : result.not_determined) {
    EXPECT_NE(what.find("(set-up 2)"), std::string::npos) << what;
    EXPECT_EQ(what.find("(set-up 1)"), std::string::npos) << what;
  }
  const std::vector<double> expected = bench.expected(plan.setups[0]);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Estimate& e = result.set_ups[0].parameters[i].estimate;
    EXPECT_NEAR(e.value, expected[i], 4.5 * e.u) << result.set_ups[0].parameters[i].name;
  }
  EXPECT_FALSE(result.set_ups[1].parameters[2].estimate.determined());
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SetUpLaw, ::testing::Values("cone", "cylinder"), name_of);

TEST(SetUps, SeveralOfOneClampingAreOnePath) {
  LawCase c;
  c.half_angle_deg = 3.0, c.x_mm = 0.2, c.slope_x = 0.002, c.noise_mm = 0.002, c.returns = true;
  ProbeStream stream = probe(c);
  const FitResult one = fit(stream, options_of(c));
  ASSERT_EQ(one.set_ups.size(), 1u);
  EXPECT_EQ(one.set_ups[0].parameters[4].estimate.value, one.parameters[4].estimate.value);
  for (std::size_t i = 0; i < stream.size(); ++i) stream.setup[i] = stream.pass[i];
  trueaxis::SetUp jogged;
  jogged.number = 2, jogged.x_jog_mm = 0.1;
  stream.setups = {trueaxis::SetUp{}, jogged};
  const FitResult two = fit(stream, options_of(c));
  ASSERT_EQ(two.set_ups.size(), 2u);
  for (std::size_t i = 0; i < one.parameters.size(); ++i) {
    EXPECT_EQ(two.parameters[i].estimate.value, one.parameters[i].estimate.value);
    EXPECT_EQ(two.parameters[i].estimate.u, one.parameters[i].estimate.u);
  }
  EXPECT_EQ(two.residual_mm, one.residual_mm);
}

TEST(SetUps, AStatedSideMustNotContradictTheReadings) {
  ProbeStream stream = probe(LawCase{.half_angle_deg = 3.0});
  stream.setups.front().rear = true;
  EXPECT_THROW(fit(stream, {}), InputError);
}

}  // namespace
}  // namespace trueaxis::laws
