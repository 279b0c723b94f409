// SPDX-License-Identifier: Apache-2.0
// The autoregression of noise in runs against the restricted likelihood of all readings, written
// out with dense matrices.
#include "math/autoregression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

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
  const Eigen::LLT<Eigen::MatrixXd> root(sigma);
  const Eigen::MatrixXd inner = x.transpose() * root.solve(x);
  const Eigen::LLT<Eigen::MatrixXd> of_inner(inner);
  const Eigen::VectorXd weighted = root.solve(y);
  const Eigen::VectorXd b = of_inner.solve(x.transpose() * weighted);
  const double rss = y.dot(weighted) - b.dot(inner * b);
  const auto log_det = [](const Eigen::LLT<Eigen::MatrixXd>& of) {
    return 2.0 * of.matrixLLT().diagonal().array().log().sum();
  };
  return log_det(root) + log_det(of_inner) +
         static_cast<double>(readings - x.cols()) * std::log(rss);
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

}  // namespace
}  // namespace trueaxis
