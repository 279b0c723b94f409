// SPDX-License-Identifier: Apache-2.0
// The autoregression of noise in runs against the restricted likelihood of all readings, written
// out with dense matrices.
#include "math/autoregression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/dense.hpp"

namespace trueaxis {
namespace {

constexpr Eigen::Index runs = 6, in_a_run = 14, readings = runs * in_a_run;

/// −2 ln of the restricted likelihood of φ but for a constant: ln det Σ + ln det XᵀΣ⁻¹X +
/// (n − p) ln(yᵀ P y), with Σ of stationary runs that know nothing of one another.
double deviance(double phi, const Eigen::VectorXd& y, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(readings, readings);
  for (Eigen::Index i = 0; i < readings; ++i)
    for (Eigen::Index j = 0; j < readings; ++j)
      if (i / in_a_run == j / in_a_run)
        sigma(i, j) = std::pow(phi, std::abs(i - j)) / (1.0 - phi * phi);
  const Eigen::MatrixXd root = dense::cholesky(sigma);
  const Eigen::MatrixXd white = dense::solve_lower(root, x);
  const Eigen::VectorXd left = dense::residuals(white, dense::solve_lower(root, y));
  const auto log_det = [](const Eigen::MatrixXd& lower) {
    return 2.0 * lower.diagonal().array().log().sum();
  };
  return log_det(root) + log_det(dense::cholesky(white.transpose() * white)) +
         static_cast<double>(readings - x.cols()) * std::log(left.squaredNorm());
}

/// The φ of the least deviance: golden section, after a grid has found its valley.
double most_likely(const Eigen::VectorXd& y, const Eigen::MatrixXd& x) {
  double best = 0.0;
  for (double phi = -0.98; phi < 0.985; phi += 0.02)
    if (deviance(phi, y, x) < deviance(best, y, x)) best = phi;
  double low = best - 0.02, high = std::min(best + 0.02, 0.9999);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-6) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (deviance(a, y, x) < deviance(b, y, x) ? high : low) =
        deviance(a, y, x) < deviance(b, y, x) ? b : a;
  }
  return 0.5 * (low + high);
}

// Twenty in twenty-four at least: of 84 readings φ = 0.5 has a standard error of 0.1, so that one
// in 10⁵ would not pass 5 %; 0.8 and 0.95 always do.
TEST(Autoregression, IsTheMostLikelyOfAllReadings) {
  int told = 0;
  for (const double phi : {0.5, 0.8, 0.95})
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      std::mt19937_64 random(seed);
      std::normal_distribution<double> normal;
      Eigen::MatrixXd all(readings, 4);
      for (Eigen::Index i = 0; i < readings; ++i) {
        const bool starts = i % in_a_run == 0;
        all(i, 0) = starts ? normal(random) / std::sqrt(1.0 - phi * phi)
                           : phi * all(i - 1, 0) + normal(random);
        const double along = static_cast<double>(i) / readings;
        all(i, 1) = 1.0, all(i, 2) = along, all(i, 3) = std::cos(9.0 * static_cast<double>(i));
      }
      LaggedGram gram(4);
      std::vector<Eigen::Index> first, second, others;
      for (Eigen::Index i = 0; i < readings; ++i)
        (i % in_a_run == 0 ? first : i % in_a_run == 1 ? second : others).push_back(i);
      gram.add(LaggedRows{{all, others, 3}, {all, first, 1}, {all, second, 2}});
      const Autoregression found = find_autoregression(gram, [](double, double) { return true; });
      if (found.phi.empty()) continue;
      ++told;
      // Sixteen golden sections of an interval of at most 2 leave 0.0009 of it.
      EXPECT_NEAR(found.phi[0], most_likely(all.col(0), all.rightCols(3)), 1e-3)
          << phi << ", seed " << seed;
    }
  EXPECT_GE(told, 20);
}

/// Autocovariances 0 to n − 1 of a stationary process of innovations of variance 1: sums of
/// products of its impulse response, cut off where it has died out.
std::vector<double> covariances(const std::vector<double>& phi, std::size_t n) {
  std::vector<double> response{1.0}, out;
  for (std::size_t k = 1; k < 5000; ++k) {
    double next = 0.0;
    for (std::size_t j = 1; j <= std::min(phi.size(), k); ++j) next += phi[j - 1] * response[k - j];
    response.push_back(next);
  }
  for (std::size_t lag = 0; lag < n; ++lag) {
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < response.size(); ++k) sum += response[k] * response[k + lag];
    out.push_back(sum);
  }
  return out;
}

const std::vector<double> fourth{1.67, -0.98, 0.107, 0.12};

// What a run's first readings are whitened by: with it the covariance of all is the unit matrix.
TEST(RunStart, WhitensTheFirstReadingsOfARun) {
  for (const std::vector<double>& phi :
       {std::vector{0.9}, {1.5, -0.66}, {1.7, -1.09, 0.28}, fourth}) {
    constexpr Eigen::Index n = 9;
    const std::vector<double> of_lag = covariances(phi, n);
    const RunStart start(phi);
    Eigen::MatrixXd covariance(n, n), whitening = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j)
        covariance(i, j) = of_lag[static_cast<std::size_t>(std::abs(i - j))];
      const auto k = static_cast<std::size_t>(i);
      const std::vector<double>& own = start.phi(k);
      whitening(i, i) = start.scale(k);
      for (std::size_t j = 0; j < own.size(); ++j)
        whitening(i, i - 1 - static_cast<Eigen::Index>(j)) = -start.scale(k) * own[j];
    }
    const Eigen::MatrixXd unit = whitening * covariance * whitening.transpose();
    EXPECT_LT((unit - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-9) << phi.size();
    EXPECT_NEAR(variance_over_innovation(phi), of_lag[0], 1e-9 * of_lag[0]);
  }
}

TEST(PartialCorrelations, AreThoseOfPhi) {
  const std::vector<double> partials{0.9, -0.6, 0.3, -0.1},
      back = partial_correlations(phi_of(partials));
  ASSERT_EQ(back.size(), partials.size());
  for (std::size_t k = 0; k < back.size(); ++k) EXPECT_NEAR(back[k], partials[k], 1e-12);
  EXPECT_EQ(phi_of({0.5, 0.2}), (std::vector{0.4, 0.2}));
}

// A process of order 4 in runs of 400 after an estimate of order 2. What counts is its level at low
// frequencies, 1/(1 − Σ φ), which lobes are judged by. Of N readings and p orders the level of an
// autoregression has a relative standard error of √(4p/N) as of a power, half of it as an amplitude
// (Berk 1974); the order 2 that the process itself has in the limit is too low by a third.
TEST(HigherOrders, TellTheLevelOfLowFrequencies) {
  constexpr std::size_t size = 4000, of_a_run = 400;
  const auto level = [](const std::vector<double>& phi) {
    double sum = 1.0;
    for (const double one : phi) sum -= one;
    return 1.0 / sum;
  };
  const std::vector<double> of_lag = covariances(fourth, 3);
  const double r1 = of_lag[1] / of_lag[0], r2 = of_lag[2] / of_lag[0];
  const std::vector<double> second = phi_of({r1, (r2 - r1 * r1) / (1.0 - r1 * r1)});
  const double error = 0.5 * std::sqrt(4.0 * 6.0 / size);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> noise(size + 500);
    for (std::size_t i = 4; i < noise.size(); ++i) {
      noise[i] = normal(random);
      for (std::size_t j = 0; j < 4; ++j) noise[i] += fourth[j] * noise[i - 1 - j];
    }
    std::vector<std::vector<double>> residual;
    for (std::size_t begin = 500; begin < noise.size(); begin += of_a_run)
      residual.emplace_back(noise.begin() + static_cast<long>(begin),
                            noise.begin() + static_cast<long>(begin + of_a_run));
    Autoregression before;
    before.phi = second;
    const Autoregression found = with_higher_orders(before, residual);
    EXPECT_NEAR(level(found.phi) / level(fourth), 1.0, 4.0 * error) << seed;
  }
  EXPECT_GT(std::abs(level(second) / level(fourth) - 1.0), 8.0 * error) << "order 2 would do";
}

// Three lobes of a part ring with the spindle. A hump that is 120 orders wide has its middle at a
// whole order by accident.
TEST(RingsWithSpindle, OnlyWhatIsNarrow) {
  const auto angles = [](double per_revolution) {
    std::vector<double> c(200);
    for (std::size_t i = 0; i < c.size(); ++i)
      c[i] = 2.0 * std::numbers::pi * static_cast<double>(i) / per_revolution;
    return c;
  };
  const auto at = [](double order, double per_revolution, double radius,
                     const std::vector<double>& c) {
    const double angle = 2.0 * std::numbers::pi * order / per_revolution;
    return rings_with_spindle(2.0 * radius * std::cos(angle), -radius * radius, c);
  };
  EXPECT_TRUE(at(3.0, 36.0, 0.85, angles(36.0)));
  EXPECT_FALSE(at(3.5, 36.0, 0.85, angles(36.0)));
  EXPECT_FALSE(at(3.0, 36.0, 0.7, angles(36.0)));
  EXPECT_FALSE(at(217.0, 3600.0, 0.811, angles(3600.0)));
  EXPECT_TRUE(at(217.0, 3600.0, 0.999, angles(3600.0)));
}

}  // namespace
}  // namespace trueaxis
