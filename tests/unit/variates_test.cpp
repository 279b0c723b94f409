// SPDX-License-Identifier: Apache-2.0
#include "simulate/variates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <iostream>
#include <vector>

namespace trueaxis::virtual_lathe {
namespace {

constexpr std::uint64_t seed = 20261121;
constexpr double level = 1e-4;  // of each test: a handful of them

// Known answers of Random123 (Salmon et al.), kat_vectors.
TEST(Philox, GivesTheKnownAnswers) {
  using Four = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Four{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}),
            (Four{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Four{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

/// Largest distance of the sample's distribution from `cdf`, over what a true sample exceeds with
/// probability `level` at most (Dvoretzky, Kiefer, Wolfowitz; Massart's constant).
double kolmogorov(std::vector<double> sample, const std::function<double(double)>& cdf) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = cdf(sample[i]), below = static_cast<double>(i) / n;
    distance = std::max({distance, std::abs(p - below), std::abs(p - below - 1.0 / n)});
  }
  return distance / std::sqrt(std::log(2.0 / level) / (2.0 * n));
}

TEST(Variates, NormalIsNormal) {
  std::cout << "seed " << seed << '\n';
  Xoshiro bits(seed, 1);
  std::vector<double> sample(2'000'000);
  for (double& x : sample) x = normal_variate(bits);
  const boost::math::normal normal;
  EXPECT_LE(kolmogorov(sample, [&](double x) { return cdf(normal, x); }), 1.0);
}

// Equal-probability bins and, beyond the ziggurat's base layer at 3.65, the tail on its own: 2.6e-4
// of all, which Kolmogorov's distance does not see.
TEST(Variates, NormalHasItsTailsAndNoSteps) {
  constexpr int bins = 1000, draws = 4'000'000;
  const boost::math::normal normal;
  std::vector<double> count(bins, 0.0);
  double beyond = 0.0, far_square = 0.0;
  Xoshiro bits(seed, 2);
  for (int i = 0; i < draws; ++i) {
    const double x = normal_variate(bits);
    ++count[std::min<std::size_t>(bins - 1, static_cast<std::size_t>(bins * cdf(normal, x)))];
    if (std::abs(x) > 3.6541528853610088) ++beyond, far_square += x * x;
  }
  double square = 0.0;
  const double expected = static_cast<double>(draws) / bins;
  for (const double c : count) square += (c - expected) * (c - expected) / expected;
  EXPECT_LE(square, quantile(complement(boost::math::chi_squared(bins - 1), level)));
  const double share = 2.0 * cdf(complement(normal, 3.6541528853610088));
  EXPECT_NEAR(beyond, draws * share, 4.0 * std::sqrt(draws * share));
  // E[x² | x > t] = 1 + t φ(t) / Q(t); its spread in the tail is below 2.1.
  const double mean = 1.0 + 3.6541528853610088 * pdf(normal, 3.6541528853610088) / (0.5 * share);
  EXPECT_NEAR(far_square / beyond, mean, 4.0 * 2.1 / std::sqrt(beyond));
}

TEST(Variates, AColumnHasTheBitsOfSingleDraws) {
  Xoshiro one(seed, 4), column(seed, 4);
  std::vector<double> sample(100'000, 0.5);  // a thousand of them in the rare cases
  add_normal_variates(column, 3.0, sample);
  for (const double x : sample) ASSERT_EQ(x, 0.5 + 3.0 * normal_variate(one));
  EXPECT_EQ(one(), column());
}

TEST(Variates, NormalMomentsAndNeighboursAreThoseOfIndependentDraws) {
  constexpr int draws = 4'000'000;
  Xoshiro bits(seed, 3);
  double sum = 0.0, square = 0.0, fourth = 0.0, product = 0.0, before = 0.0;
  for (int i = 0; i < draws; ++i) {
    const double x = normal_variate(bits);
    sum += x, square += x * x, fourth += x * x * x * x, product += x * before;
    before = x;
  }
  const double n = draws, four_sds = 4.0 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0.0, four_sds);
  EXPECT_NEAR(square / n, 1.0, four_sds * std::sqrt(2.0));   // variance of x²: 2
  EXPECT_NEAR(fourth / n, 3.0, four_sds * std::sqrt(96.0));  // of x⁴: 105 − 9
  EXPECT_NEAR(product / n, 0.0, four_sds);
}

TEST(Variates, StudentIsStudentOfStandardDeviationOne) {
  for (const double dof : {2.5, 3.0, 7.0, 40.0}) {
    Xoshiro bits(seed, static_cast<std::uint32_t>(10 + dof));
    std::vector<double> sample(500'000);
    for (double& x : sample) x = student_variate(bits, dof);
    const boost::math::students_t student(dof);
    const double scale = std::sqrt(dof / (dof - 2.0));
    EXPECT_LE(kolmogorov(sample, [&](double x) { return cdf(student, x * scale); }), 1.0) << dof;
  }
}

}  // namespace
}  // namespace trueaxis::virtual_lathe
