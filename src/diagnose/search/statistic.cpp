// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/statistic.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace trueaxis::diagnose_detail {
namespace {

// The second harmonic of j jaws that is no surprise yet. A thin ring has ((j² − 1)/(4j² − 1))² of
// the first, below 1/16 for any j. Chosen, not derived: five times that, for jaws that press over
// a width and not all alike. Twice as much costs 32 ln² 2 = 15 in 2 ln L.
constexpr double most_second = 0.3;
constexpr double second_surprise = 32.0;

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
  const Solution s = solve(total - fold, columns);
  const Eigen::VectorXd right = fold(columns, 0);
  const Eigen::MatrixXd left = fold(columns, columns);
  return fold(0, 0) - 2.0 * s.coefficients.dot(right) + s.coefficients.dot(left * s.coefficients);
}

}  // namespace trueaxis::diagnose_detail
