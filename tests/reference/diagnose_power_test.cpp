// SPDX-License-Identifier: Apache-2.0
// The score test of one preset cause on white noise against the table of theory.md, and its
// amplitude against the Cramér-Rao bound.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <cmath>
#include <iostream>

#include "diagnose/search/search.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;
using testing::HelixPlan;

constexpr double sigma_mm = 0.01, level = 0.05, tail = 5e-5;
constexpr int streams = 600;
constexpr std::uint64_t seed = 20261121;

struct Point {
  double amplitude_um, power;
};

struct Bench {
  LinearisationPoint point = testing::bench_point(HelixPlan{}, 0.1);
  ObservationMask mask = make_observation_mask(point);
  std::vector<Hypothesis> lobes{testing::roundness(3)};

  std::vector<double> deviation(double amplitude_mm, double phase, int stream) const {
    auto y = testing::white_noise(point.size(), sigma_mm,
                                  seed + 100003u * static_cast<std::uint64_t>(stream));
    // Along the normal: on a cone of tan α = 0.1 the probe sees secα of it.
    const double along = std::sqrt(1.01);
    const std::vector<double> theta = point.column(&PointPart::theta);
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += along * amplitude_mm * std::cos(3.0 * theta[i] - phase);
    return y;
  }
};

// λ = N a² sec²α/(2 σ²), and the power that of the noncentral F with 2 and N − 6 − 2 degrees of
// freedom; the table's powers belong to amplitudes rounded to 0.01 µm, seen without the secant
// (0.5 % of the amplitude): both together move them by less than 0.012.
TEST(PowerOfOneCause, IsTheTable) {
  std::cout << "seed " << seed << ", " << streams << " streams a point\n";
  const Bench b;
  const Point table[] = {{0.0, level}, {0.81, 0.5},  {1.14, 0.8},
                         {1.30, 0.9},  {1.44, 0.95}, {1.69, 0.99}};
  const auto n = static_cast<double>(b.point.size());
  int number = 0;
  for (const Point& point : table) {
    int found = 0;
    for (int s = 0; s < streams; ++s, ++number) {
      const auto y = b.deviation(point.amplitude_um * 1e-3, 0.01 * number, number);
      NormalEquations equations(b.point, b.mask, y, {}, 1);
      const Columns own = equations.append(b.lobes).front();
      const Projection left = project(equations.total(), equations.base());
      const Score gained = score(left, own);
      ASSERT_EQ(gained.rank, 2u);
      found += log_p_value(gained.gain, 2.0, left.rss,
                           static_cast<double>(equations.count() - left.rank)) < std::log(level);
    }
    const double a = point.amplitude_um / 10.0, lambda = n * a * a * 1.01 / 2.0;
    const boost::math::fisher_f central(2.0, n - 8.0);
    const double critical = quantile(complement(central, level));
    const double power =
        lambda > 0.0 ? cdf(complement(boost::math::non_central_f(2.0, n - 8.0, lambda), critical))
                     : level;
    std::cout << point.amplitude_um << " um: found " << found << " of " << streams << ", power "
              << power << ", table " << point.power << '\n';
    EXPECT_NEAR(power, point.power, 0.012);
    const boost::math::binomial hits(streams, power);
    EXPECT_GE(found, quantile(hits, tail)) << point.amplitude_um;
    EXPECT_LE(found, quantile(complement(hits, tail))) << point.amplitude_um;
  }
}

// Cramér-Rao of an amplitude: σ √(2/N) = 0.365 µm; over M streams the sum of squares is χ² of M.
TEST(AmplitudeOfOneCause, ReachesCramerRao) {
  std::cout << "seed " << seed << ", " << streams << " streams\n";
  const Bench b;
  const double bound = sigma_mm * std::sqrt(2.0 / static_cast<double>(b.point.size()));
  EXPECT_NEAR(bound, 0.365e-3, 0.0005e-3);
  constexpr double truth = 0.02;
  double sum = 0.0, u_sum = 0.0;
  for (int s = 0; s < streams; ++s) {
    const auto y = b.deviation(truth, 0.02 * s, 5000 + s);
    NormalEquations equations(b.point, b.mask, y, {}, 1);
    Columns all = equations.base();
    const Columns own = equations.append(b.lobes).front();
    all.insert(all.end(), own.begin(), own.end());
    const Solution solution = solve(equations.total(), all);
    const auto n = solution.coefficients.size();
    sum += std::pow(solution.coefficients.tail(2).norm() - truth, 2);
    u_sum += sigma_mm * std::sqrt(solution.inverse(n - 1, n - 1));
  }
  const boost::math::chi_squared square(streams);
  const double ratio2 = sum / (bound * bound) * 1.01;  // the probe sees secα of the form
  EXPECT_GT(ratio2, quantile(square, tail));
  EXPECT_LT(ratio2, quantile(complement(square, tail)));
  EXPECT_NEAR(u_sum / streams * std::sqrt(1.01), bound, 0.01 * bound);  // what the surface takes
}

}  // namespace
}  // namespace trueaxis
