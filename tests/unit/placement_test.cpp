// SPDX-License-Identifier: Apache-2.0
#include "studies/published/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/published/likelihood_profile.hpp"
#include "studies/published/printed_run.hpp"
#include "study/bound/quantities.hpp"
#include "support/sweep_examples.hpp"

namespace trueaxis::study {
namespace {

/// Two parameters with standard deviations 3 and 4 and correlation 0.5, printed to steps of 1.
PrintedRun two_parameters() {
  PrintedRun run;
  run.truth = {10.2, 20.0};
  run.error = {1.8, -2.0};
  run.step = {1.0, 1.0};
  run.covariance.resize(2, 2);
  run.covariance << 9.0, 6.0, 6.0, 16.0;
  return run;
}

TEST(PrintedRun, DistanceAndLikelihoodAreThoseOfTheFormula) {
  const PrintedRun run = two_parameters();
  for (const double f : {0.5, 1.0, 2.0}) {
    const double a = 9.0 * f * f + 1.0 / 12.0, b = 6.0 * f * f, c = 16.0 * f * f + 1.0 / 12.0;
    const double det = a * c - b * b;
    const double chi_squared =
        (c * 1.8 * 1.8 - 2.0 * b * 1.8 * -2.0 + a * 2.0 * 2.0) / det;  // 2 × 2 inverse
    const PrintedRun::Likelihood at = run.at(f);
    EXPECT_NEAR(at.chi_squared, chi_squared, 1e-12 * chi_squared);
    EXPECT_NEAR(at.log_likelihood,
                -0.5 * chi_squared - 0.5 * std::log(det) - std::log(2.0 * std::acos(-1.0)), 1e-12);
    EXPECT_NEAR(run.in_sd(f)[1], -2.0 / (4.0 * f), 1e-15);
  }
}

TEST(PrintedRun, ErrorsAreRoundedAsTheirNumbersAre) {
  const PrintedRun run = two_parameters();
  EXPECT_NEAR(run.as_printed(0, 0.25), -0.2, 1e-12);  // 10.45 prints as 10
  EXPECT_NEAR(run.as_printed(0, 0.35), 0.8, 1e-12);   // 10.55 as 11
}

TEST(PrintedRun, AnErrorPrintedTwiceAsLargeIsHalved) {
  PublishedRow row{"", 0, {}, {{"15.498", 15.498, 3}}};
  PublishedReading reading{"", {}, {2.0}, 1.0, false, {0}};
  Bound bound;
  bound.covariance = {1e-6};
  const PrintedRun run = printed_run(row, reading, {0}, {15.5}, bound);
  EXPECT_NEAR(run.error[0], -0.001, 1e-12);
  EXPECT_NEAR(run.step[0], 0.0005, 1e-15);
  // The density of the printed number is that of the halved error, over two.
  const PrintedRun::Likelihood at = run.at(1.0);
  const double variance = 1e-6 + 0.0005 * 0.0005 / 12.0;
  EXPECT_NEAR(
      at.log_likelihood,
      -0.5 * 1e-6 / variance - 0.5 * std::log(2.0 * std::acos(-1.0) * variance) - std::log(2.0),
      1e-9);
  reading.least_decimals = {4};
  EXPECT_NEAR(printed_run(row, reading, {0}, {15.5}, bound).step[0], 0.00005, 1e-15);
}

/// n Gaussian values of mean square s²: −n ln σ − n s² / 2σ² has its maximum at s.
TEST(LikelihoodProfile, MaximumAndIntervalOfAStandardDeviation) {
  constexpr double n = 12.0, s = 0.37;
  const auto log_likelihood = [](double sigma) {
    return -n * std::log(sigma) - 0.5 * n * s * s / (sigma * sigma);
  };
  const LikelihoodProfile profile(log_likelihood, 1e-3, 1e3);
  EXPECT_NEAR(profile.best(), s, 1e-4 * s);  // Brent: the root of its precision
  EXPECT_NEAR(profile.highest(), log_likelihood(s), 1e-9);
  for (const double end : {profile.interval_95().low, profile.interval_95().high})
    EXPECT_NEAR(2.0 * (log_likelihood(s) - log_likelihood(end)), 3.841458820694124, 1e-4);
  EXPECT_LT(profile.interval_95().low, s);
  EXPECT_GT(profile.interval_95().high, s);
}

TEST(LikelihoodProfile, AnEndThatIsNeverReachedIsOpen) {
  // Readings without a spread, compared with rounding: any small σ will do.
  const LikelihoodProfile profile([](double sigma) { return -0.5 * std::log(1.0 + sigma * sigma); },
                                  1e-3, 1e3);
  EXPECT_TRUE(std::isnan(profile.interval_95().low));
  EXPECT_NEAR(profile.interval_95().high, std::sqrt(std::exp(3.841458820694124) - 1.0), 1e-4);
}

/// A run of the sweep itself, taken for a published one: the readings know its noise.
class OwnRun : public ::testing::Test {
 protected:
  void SetUp() override {
    sweep_.base = testing::probed_part(virtual_lathe::PartKind::cone);
    sweep_.axes = {testing::over("noise.sigma_mm", {0.005, 0.010})};
    sweep_.repeats = 400, sweep_.seed = 20261122;
    results_ = testing::run_all(sweep_, 1);
    for (std::size_t i = 0; i < 6; ++i)
      published_.parameters.push_back(quantities(fitted_surface(sweep_))[i].name);
    for (std::size_t repeat = 0; repeat < 20; ++repeat) published_.rows.push_back(row(repeat));
    const std::vector<double> ones(6, 1.0);
    const std::vector<int> all_printed(6, 0);
    published_.readings = {{"as stated", {}, ones, 1.0, false, all_printed},
                           {"fitted", {}, ones, 1.0, true, all_printed},
                           {"a tenth", {}, ones, 0.1, false, all_printed}};
  }

  const BlockResult& block(std::size_t cell) const {
    for (const BlockResult& result : results_)
      if (result.block.cell == cell && result.block.first_repeat == 0) return result;
    throw std::logic_error("no block");
  }

  /// A repeat of the second level, printed to ten decimals.
  PublishedRow row(std::size_t repeat) const {
    const BlockResult& from = block(1);
    PublishedRow out{"run", 1, {}, {}};
    for (std::size_t i = 0; i < 6; ++i)
      out.values.push_back(
          {"", from.facts[0].truth[i] + from.error[repeat * from.quantities + i], 10});
    return out;
  }

  Sweep sweep_;
  Published published_;
  std::vector<BlockResult> results_;
};

TEST_F(OwnRun, DistancesAreChiSquaredAndThePlaceAmongTheRepeatsAgrees) {
  const Placement placement = place_published(sweep_, published_, results_);
  const PlacedReading& stated = placement.readings[0];
  // χ²(120) of 20 efficient runs: mean 120, standard deviation √240; four of them.
  EXPECT_NEAR(stated.chi_squared, 120.0, 4.0 * std::sqrt(240.0)) << "seed " << sweep_.seed;
  ASSERT_EQ(placement.among.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const double p = stated.rows[i].p_value;
    EXPECT_NEAR(placement.among[i].share_as_far, p,
                4.5 * std::sqrt(std::max(p * (1.0 - p), 0.01) / 400.0))
        << "run " << i << ", seed " << sweep_.seed;
    for (std::size_t k = 0; k < 6; ++k) {
      const double normal = 0.5 * std::erfc(-stated.rows[i].in_sd[k] / std::sqrt(2.0));
      EXPECT_NEAR(placement.among[i].share_below[k], normal,
                  4.5 * std::sqrt(std::max(normal * (1.0 - normal), 0.01) / 400.0))
          << "run " << i << ", parameter " << k << ", seed " << sweep_.seed;
    }
  }
}

TEST_F(OwnRun, TheFittedNoiseIsTheOneThatWasDrawn) {
  const Placement placement = place_published(sweep_, published_, results_);
  const PlacedReading& fitted = placement.readings[1];
  // 120 squares: the maximum is √(χ²/120), its interval as wide as 1.96/√240 on either side.
  EXPECT_NEAR(fitted.noise_factor, std::sqrt(placement.readings[0].chi_squared / 120.0), 1e-3);
  EXPECT_NEAR(fitted.noise_factor_95.high / fitted.noise_factor_95.low,
              std::exp(2.0 * 1.96 / std::sqrt(240.0)), 0.01);
  EXPECT_GE(fitted.gain, 0.0);
  EXPECT_LT(placement.readings[2].gain, -1000.0) << "a tenth of the noise explains nothing";
}

TEST_F(OwnRun, ALostLevelIsFoundAgain) {
  std::vector<PublishedRow>& rows = published_.rows;
  rows = {row(0), row(1), row(2), row(3)};
  rows[3].unknown_axis = 0;
  rows[3].grid = 0;
  const Placement placement = place_published(sweep_, published_, results_);
  ASSERT_EQ(placement.readings[0].rows.size(), 3u);
  ASSERT_EQ(placement.unknown.size(), 3u);
  const UnknownLevel& level = placement.unknown[0];
  const std::vector<double> alone = [&] {
    rows[3].unknown_axis.reset();
    rows[3].grid = 1;
    const Placement known = place_published(sweep_, published_, results_);
    return std::vector{known.readings[0].rows[3].chi_squared};
  }();
  EXPECT_NEAR(level.best, 0.010 * std::sqrt(alone[0] / 6.0), 1e-5) << "the run's own scatter";
  EXPECT_LT(level.interval_95.low, level.best);
  EXPECT_GT(level.interval_95.high, level.best);
  // If the factor is fitted too, three runs of six numbers say less than a known factor.
  const UnknownLevel& fitted = placement.unknown[1];
  EXPECT_GT(fitted.interval_95.high / fitted.interval_95.low,
            level.interval_95.high / level.interval_95.low);
  EXPECT_NEAR(placement.unknown[2].best, 10.0 * level.best, 1e-3 * 10.0 * level.best);
}

TEST_F(OwnRun, WithoutABoundNothingIsPlaced) {
  published_.readings[2].settings = {{"pass.length_mm", 1e-3}};  // one reading
  const Placement placement = place_published(sweep_, published_, results_);
  EXPECT_NE(placement.why_not.find("\"a tenth\" has no bound"), std::string::npos);
  EXPECT_TRUE(placement.readings.empty());
}

}  // namespace
}  // namespace trueaxis::study
