// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <iostream>
#include <set>

#include "diagnose/regression/noise.hpp"
#include "diagnose/regression/outliers.hpp"
#include "diagnose/search/dictionary.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

constexpr double sigma_mm = 0.01;
constexpr std::uint64_t seed = 77;

struct Bench {
  LinearisationPoint point = testing::bench_point({}, 0.1);
  ObservationMask mask = make_observation_mask(point);
  Resolution resolution = resolution_of(point, mask);

  /// Noise with three lobes of fifty times its size.
  std::vector<double> with_lobes(std::vector<double> noise) const {
    const std::vector<double> theta = point.column(&PointPart::theta);
    for (std::size_t i = 0; i < noise.size(); ++i)
      noise[i] += 50.0 * sigma_mm * std::cos(3.0 * theta[i] - 0.4);
    return noise;
  }
};

// A basis whose products are made once, and further terms: the same numbers in the same order as
// of all at once, on one thread and on three.
TEST(NoiseEstimator, IsThatOfAllColumnsToTheLastBit) {
  const Bench b;
  const std::vector<Hypothesis> basis = small_fourier_legendre_basis(b.point, b.resolution);
  const auto y = b.with_lobes(testing::correlated_noise(b.point.size(), sigma_mm, 0.6, seed));
  const std::vector<Hypothesis> terms{of_effect("spindle.asynchronous", {.order = 0.42}),
                                      of_effect("probe.gain", {.reference_x_mm = 40.0})};
  std::vector<Hypothesis> all = basis;
  all.insert(all.end(), terms.begin(), terms.end());
  const Autoregression at_once = autoregression(b.point, b.mask, y, all);
  ASSERT_FALSE(at_once.phi.empty());
  for (const int threads : {1, 3}) {
    const NoiseEstimator estimator(b.point, b.mask, y, basis, threads);
    EXPECT_EQ(estimator({}).phi, autoregression(b.point, b.mask, y, basis).phi);
    const Autoregression found = estimator(terms);
    EXPECT_EQ(found.phi, at_once.phi);
    EXPECT_EQ(found.rss, at_once.rss);
    EXPECT_EQ(found.freedom, at_once.freedom);
  }
}

// √((1 − ρ²)/N) is the standard error of one stream (Box and Jenkins); the mean of M has 1/√M of
// it, to which the bias of an AR(1) after p columns adds at most (1 + 3ρ)/N.
class Correlation : public ::testing::TestWithParam<double> {};

TEST_P(Correlation, IsFoundBesideAStrongHarmonic) {
  constexpr int streams = 12;
  const double rho = GetParam();
  std::cout << "seed " << seed << '\n';
  const Bench b;
  const std::vector<Hypothesis> basis = small_fourier_legendre_basis(b.point, b.resolution);
  const auto n = static_cast<double>(b.point.size());
  const double error = std::sqrt((1.0 - rho * rho) / n);
  double sum = 0.0;
  for (int s = 0; s < streams; ++s) {
    const auto y = b.with_lobes(testing::correlated_noise(b.point.size(), sigma_mm, rho,
                                                          seed + static_cast<std::uint64_t>(s)));
    const std::vector<double> found = autoregression(b.point, b.mask, y, basis).phi;
    ASSERT_FALSE(found.empty()) << s;
    // Of a second order φ₁/(1 − φ₂) is the correlation of neighbours.
    const double neighbours = found.size() == 1 ? found[0] : found[0] / (1.0 - found[1]);
    EXPECT_NEAR(neighbours, rho, 4.0 * error + (1.0 + 3.0 * rho) / n) << s;
    sum += neighbours;
  }
  EXPECT_NEAR(sum / streams, rho, 4.0 * error / std::sqrt(streams) + (1.0 + 3.0 * rho) / n);
}

INSTANTIATE_TEST_SUITE_P(Rho, Correlation, ::testing::Values(0.5, 0.8));

// First order at 5 %, or second order: at 5 % after the first, and beyond 2 × 3.84 against white.
// The two likelihood ratios are independent χ² of one degree of freedom.
TEST(Autoregression, FindsNothingInWhiteNoise) {
  constexpr int streams = 250;
  std::cout << "seed " << seed << ", " << streams << " streams\n";
  const boost::math::chi_squared one(1.0);
  double level = cdf(complement(one, 3.84));
  for (double x = 0.0; x < 3.84; x += 1e-3)
    level += (cdf(one, x + 1e-3) - cdf(one, x)) * cdf(complement(one, 7.68 - x));
  const Bench b;
  const std::vector<Hypothesis> basis = small_fourier_legendre_basis(b.point, b.resolution);
  int found = 0;
  for (int s = 0; s < streams; ++s) {
    const auto y = b.with_lobes(testing::white_noise(b.point.size(), sigma_mm,
                                                     1000 + seed + static_cast<std::uint64_t>(s)));
    found += !autoregression(b.point, b.mask, y, basis).phi.empty();
  }
  const boost::math::binomial hits(streams, level);
  std::cout << "level " << level << ", found in " << found << '\n';
  EXPECT_GE(found, quantile(hits, 5e-4));
  EXPECT_LE(found, quantile(complement(hits, 5e-4)));
}

std::set<std::size_t> masked_rows(const Bench& b, const std::vector<double>& y) {
  const Outliers found =
      find_outliers(b.point, small_fourier_legendre_basis(b.point, b.resolution), y, b.mask);
  std::set<std::size_t> out;
  for (const Rejected& r : found.list) out.insert(r.row - 1);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_EQ(found.mask.used[i] == 0, out.contains(i));
  return out;
}

// Far out is 8 σ of the MAD: chips of 20 σ are excluded among noise of one and lobes of 50 σ; of
// 1500 white readings none comes near 8 σ.
TEST(FindOutliers, MasksChipsAndNothingElse) {
  const Bench b;
  std::vector<double> y = b.with_lobes(testing::white_noise(b.point.size(), sigma_mm, seed));
  EXPECT_TRUE(masked_rows(b, y).empty());
  std::set<std::size_t> chips;
  for (std::size_t i = 31; i < y.size(); i += 97) {
    y[i] += 20.0 * sigma_mm;
    chips.insert(i);
  }
  EXPECT_EQ(masked_rows(b, y), chips);
  const std::vector<double> six = [&] {
    std::vector<double> v = testing::white_noise(b.point.size(), 0.1 * sigma_mm, seed);
    const std::vector<double> alternating =
        testing::white_noise(b.point.size(), sigma_mm, seed + 1);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += alternating[i];
    for (std::size_t i = 31; i < v.size(); i += 97) v[i] = 5.5 * sigma_mm;
    return v;
  }();
  EXPECT_TRUE(masked_rows(b, six).empty());  // 5.5 σ is not far out
}

// A dent whose peak is 4.5 σ is a form and stays, noise and all.
TEST(FindOutliers, KeepsALocalDent) {
  const Bench b;
  std::vector<double> y = testing::white_noise(b.point.size(), sigma_mm, seed);
  std::size_t touched = 0;
  const std::vector<double> theta = b.point.column(&PointPart::theta);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double v = std::remainder(theta[i] - 1.0, two_pi) / 0.15;
    const double w = (b.point.z[i] - 30.0) / 4.0;
    const double dent = 4.5 * sigma_mm * std::exp(-0.5 * (v * v + w * w));
    touched += dent > sigma_mm;
    y[i] -= dent;
  }
  ASSERT_GT(touched, 8u);
  EXPECT_TRUE(masked_rows(b, y).empty());
}

}  // namespace
}  // namespace trueaxis
