// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/statistic.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <optional>

#include "math/lower_triangle.hpp"

namespace trueaxis::diagnose_detail {
namespace {

// The second harmonic of j jaws that is no surprise yet. A thin ring has ((j² − 1)/(4j² − 1))² of
// the first, below 1/16 for any j. Chosen, not derived: five times that, for jaws that press over
// a width and not all alike. Twice as much costs 32 ln² 2 = 15 in 2 ln L.
constexpr double most_second = 0.3;
constexpr double second_surprise = 32.0;
// Of a normal matrix scaled to a diagonal of 1: its smallest eigenvalue is at least that over e.
constexpr double independent_determinant = 1e-10;

/// Σ of squares of the readings of a block less what coefficients make of the columns.
double left_of(const Eigen::MatrixXd& fold, const Columns& columns,
               const Eigen::VectorXd& coefficients) {
  const Eigen::VectorXd right = fold(columns, 0);
  const Eigen::MatrixXd left = fold(columns, columns);
  return fold(0, 0) - 2.0 * coefficients.dot(right) + coefficients.dot(left * coefficients);
}

/// Those of the other blocks, by a Cholesky factor; nothing where columns may depend.
std::optional<Eigen::VectorXd> independent_coefficients(const Eigen::MatrixXd& total,
                                                        const Eigen::MatrixXd& fold,
                                                        const Columns& columns) {
  const std::size_t n = columns.size();
  const auto place = [&](std::size_t j) {
    return static_cast<Eigen::Index>(j < n ? columns[j] : 0);
  };
  LowerTriangle normal(n + 1);  // the readings last
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i <= n; ++i)
      normal(i, j) = total(place(i), place(j)) - fold(place(i), place(j));
  std::vector<double> norm2;
  for (std::size_t j = 0; j < n; ++j) norm2.push_back(normal(j, j));
  if (!normal.eliminate(n)) return {};
  double determinant = 1.0;
  for (std::size_t j = 0; j < n; ++j) determinant *= normal(j, j) * normal(j, j) / norm2[j];
  if (!(determinant > independent_determinant)) return {};
  Eigen::VectorXd out(static_cast<Eigen::Index>(n));
  for (std::size_t j = n; j-- > 0;) {
    double sum = normal(n, j);
    for (std::size_t i = j + 1; i < n; ++i) sum -= normal(i, j) * out(static_cast<Eigen::Index>(i));
    out(static_cast<Eigen::Index>(j)) = sum / normal(j, j);
  }
  return out;
}

}  // namespace

double log_p_value(double gain, double rank, double rss, double freedom) {
  const double left = freedom - rank;
  if (!(gain > 0.0) || rank < 1.0 || left < 1.0) return 0.0;
  const double rest = std::max(rss - gain, 1e-12 * rss);
  const double f = gain / rank / (rest / left);
  // Far out the tail of the F distribution is (1 + q F/ν)^(−ν/2) up to a factor that changes
  // slowly.
  if (f * rank > 600.0 && left > 60.0) return -0.5 * left * std::log1p(rank * f / left);
  const boost::math::fisher_f distribution(rank, left);
  const double p = cdf(complement(distribution, f));
  return p > 0.0 ? std::log(p) : -700.0;
}

double Family::p_value(double single_p) const {
  if (!(single_p < 1.0)) return 1.0;
  const double z = single_p > 0.0 ? -std::log(single_p) : 700.0;
  return -std::expm1(-single_p * (single + bandwidth * std::sqrt(std::max(z, 1.0))));
}

double Family::threshold(double level) const {
  // e^(−z/2) is the p-value of a statistic z. Bisected until two numbers have none between them.
  const auto excess = [&](double z) { return p_value(std::exp(-0.5 * z)) - level; };
  const auto never = [](double, double) { return false; };
  std::uintmax_t steps = 100;
  return boost::math::tools::bisect(excess, 0.0, 400.0, never, steps).second;
}

double choice_of(const Hypothesis& hypothesis, const Eigen::VectorXd& coefficients) {
  const double sum = 2.0 * std::log(std::max(hypothesis.tests, 1.0));
  if (!hypothesis.effect || !has_two_orders(hypothesis.effect->term) || coefficients.size() != 4)
    return sum;
  const double first = std::hypot(coefficients(0), coefficients(1));
  const double second = std::hypot(coefficients(2), coefficients(3));
  if (second <= most_second * first) return sum;
  return sum +
         second_surprise * std::pow(std::log(second / (most_second * std::max(first, 1e-12))), 2);
}

double held_out(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold, const Columns& columns) {
  return left_of(fold, columns, solve(total - fold, columns).coefficients);
}

double held_out_fast(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold,
                     const Columns& columns) {
  const auto coefficients = independent_coefficients(total, fold, columns);
  return coefficients ? left_of(fold, columns, *coefficients) : held_out(total, fold, columns);
}

}  // namespace trueaxis::diagnose_detail
