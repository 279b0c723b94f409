// SPDX-License-Identifier: Apache-2.0
// Law: chips and coolant do not move a robust fit beyond its uncertainty, and the rejected readings
// are the ones that were spoiled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "laws/law_case.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::laws {
namespace {

constexpr double sigma_mm = 0.002;

LawCase example(const std::string& surface, std::uint64_t seed) {
  LawCase c;
  c.surface = surface, c.noise_mm = sigma_mm, c.seed = seed;
  c.half_angle_deg = surface == "cone" ? -15.0 : 0.0;
  c.end_mm = surface == "section" ? 0.0 : 40.0;
  c.x_mm = 0.8, c.y_mm = -0.3, c.revolutions = 97.0;  // 1000 readings
  if (surface != "section") c.slope_x = 4e-3, c.slope_y = -2e-3;
  return c;
}

virtual_lathe::Simulation spoiled(const LawCase& c, double share, double size_mm) {
  virtual_lathe::Scenario scenario = scenario_of(c);
  scenario.noise.outlier_fraction = share;
  scenario.noise.outlier_size_mm = size_mm;
  scenario.noise.outliers_one_sided = true;
  virtual_lathe::Simulation out = virtual_lathe::simulate_with_truth(scenario);
  if (c.surface == "section") out.stream.position_mm.clear();
  return out;
}

/// |value − truth| ≤ 4.5 u + bias for every parameter: 1 in 10⁵ fails, over some 300 checks.
void expect_near_truth(const LawCase& c, const FitResult& result, double bias_in_u = 0.0) {
  ASSERT_EQ(result.status, FitStatus::converged) << result.message;
  const std::vector<double> expected = expected_parameters(c);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Estimate& e = result.parameters[i].estimate;
    EXPECT_NEAR(e.value, expected[i], (4.5 + bias_in_u) * e.u) << result.parameters[i].name;
  }
}

class RobustLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(RobustLaw, TukeyRejectsTheChipsAndNothingElse) {
  struct Example {
    double share, size_mm;
  };
  for (const Example& spoil : std::initializer_list<Example>{
           {0.05, 50.0 * sigma_mm}, {0.3, 50.0 * sigma_mm}, {0.3, 500.0 * sigma_mm}, {0.1, 10.0}}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const LawCase c = example(GetParam(), seed);
      SCOPED_TRACE(::testing::Message()
                   << spoil.share << " of " << spoil.size_mm << " mm " << to_literal(c));
      const auto simulation = spoiled(c, spoil.share, spoil.size_mm);
      FitOptions options = options_of(c);
      options.loss = Loss::tukey;
      const FitResult result = fit(simulation.stream, options);
      expect_near_truth(c, result);
      EXPECT_NEAR(result.sigma_mm, sigma_mm, (0.2 + 2.0 * spoil.share) * sigma_mm);
      std::set<std::size_t> rejected;
      for (const Rejected& r : result.rejected) rejected.insert(r.row - 1);
      for (const std::size_t row : simulation.truth.outlier_rows)
        EXPECT_TRUE(rejected.contains(row)) << "row " << row + 1;
      // A Gaussian reading lies beyond 4.685 σ with probability 2.8e-6.
      EXPECT_LE(rejected.size(), simulation.truth.outlier_rows.size() + 2);
    }
  }
}

TEST_P(RobustLaw, HuberIsBiasedByAFractionOfTheNoise) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const LawCase c = example(GetParam(), seed);
    SCOPED_TRACE(to_literal(c));
    const auto simulation = spoiled(c, 0.05, 50.0 * sigma_mm);
    FitOptions options = options_of(c);
    options.loss = Loss::huber;
    const FitResult result = fit(simulation.stream, options);
    // One-sided: ψ of an outlier is 1.345 σ, so the level moves by 0.05 · 1.345 / 0.82 = 0.08 σ,
    // which is 2.6 u of a mean of 1000 readings; correlated parameters carry some of it.
    expect_near_truth(c, result, 3.0);
    options.loss = Loss::plain;
    const FitResult plain = fit(simulation.stream, options);
    EXPECT_GT(plain.rms_mm, 5.0 * sigma_mm);
    ASSERT_FALSE(plain.notes.empty());
    EXPECT_NE(plain.notes.back().find("outliers"), std::string::npos);
  }
}

// The σ of 1000 residuals from their median is uncertain by 4 %: 8 σ are beyond 6 of it, 4.5 are
// not.
TEST_P(RobustLaw, APlainFitCountsWhatLiesBeyondSixSigma) {
  const LawCase c = example(GetParam(), 3);
  SCOPED_TRACE(to_literal(c));
  ProbeStream stream = probe(c);
  const std::vector<double> residual_mm = fit(stream, options_of(c)).residual_mm;
  const auto lies = [&](std::size_t row, double sds) {
    stream.reading_mm[row] += sds * sigma_mm - residual_mm[row];
  };
  lies(100, 8.0), lies(500, -8.0), lies(700, 4.5), lies(800, -4.5);
  const FitResult plain = fit(stream, options_of(c));
  ASSERT_FALSE(plain.notes.empty());
  EXPECT_NE(plain.notes.back().find("2 readings lie"), std::string::npos) << plain.notes.back();
}

TEST_P(RobustLaw, OnCleanReadingsLikeLeastSquares) {
  for (const Loss loss : {Loss::huber, Loss::tukey}) {
    double mean = 0.0;  // of u over that of least squares
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const LawCase c = example(GetParam(), seed);
      SCOPED_TRACE(::testing::Message() << to_string(loss) << ' ' << to_literal(c));
      FitOptions options = options_of(c);
      const FitResult plain = fit(probe(c), options);
      options.loss = loss;
      const FitResult robust = fit(probe(c), options);
      expect_near_truth(c, robust);
      for (std::size_t i = 0; i < plain.parameters.size(); ++i) {
        const Estimate& p = plain.parameters[i].estimate;
        const Estimate& r = robust.parameters[i].estimate;
        // 95 % efficient: the two differ by √(1/0.95 − 1) = 0.23 u; five times that.
        EXPECT_NEAR(r.value, p.value, 1.15 * p.u);
        // u² grows by 1/0.95; MAD of 1000 readings is uncertain by 4 %.
        EXPECT_NEAR(r.u / p.u, std::sqrt(1.0 / 0.95), 0.2);
        mean += r.u / p.u / static_cast<double>(8 * plain.parameters.size());
      }
    }
    // Of 8000 readings the root of a mean square of ψ is known to 0.8 %, and most of it is in both.
    EXPECT_NEAR(mean, std::sqrt(1.0 / 0.95), 0.008);
  }
}

TEST_P(RobustLaw, WithoutNoise) {
  for (const Loss loss : {Loss::huber, Loss::tukey}) {
    for (const double share : {0.0, 0.1}) {
      LawCase c = example(GetParam(), 1);
      c.noise_mm = 0.0;
      SCOPED_TRACE(::testing::Message() << to_string(loss) << ' ' << share << ' ' << to_literal(c));
      FitOptions options = options_of(c);
      options.loss = loss;
      const auto simulation = spoiled(c, share, 1.0);
      const FitResult result = fit(simulation.stream, options);
      ASSERT_EQ(result.status, FitStatus::converged) << result.message;
      const std::vector<double> expected = expected_parameters(c);
      for (std::size_t i = 0; i < expected.size(); ++i)  // Huber's bias shrinks with the scale
        EXPECT_NEAR(result.parameters[i].estimate.value, expected[i],
                    1e-9 * (1.0 + std::abs(expected[i])));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, RobustLaw, ::testing::ValuesIn(catalogue_ids()), name_of);

}  // namespace
}  // namespace trueaxis::laws
