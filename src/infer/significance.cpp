// SPDX-License-Identifier: Apache-2.0
#include "infer/significance.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace trueaxis::infer {
namespace {

// Of the statistic as χ²: beyond so many times the threshold the power is 1 to rounding.
constexpr double surely_found = 40.0;

}  // namespace

double log_p_value(double gain, double rank, double rss, double freedom) {
  const double left = freedom - rank;
  if (!(gain > 0.0) || !(rss > 0.0) || rank < 1.0 || left < 1.0) return 0.0;
  const double rest = std::max(rss - gain, 1e-12 * rss);
  const double f = gain / rank / (rest / left);
  // Far out the tail of the F distribution is (1 + q F/ν)^(−ν/2) up to a factor that changes
  // slowly.
  const double log_tail = -0.5 * left * std::log1p(rank * f / left);
  if (f * rank > 600.0 && left > 60.0) return log_tail;
  const boost::math::fisher_f distribution(rank, left);
  const double p = cdf(complement(distribution, f));
  return p > 0.0 ? std::log(p) : log_tail;
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

double Family::single_level(double level) const { return std::exp(-0.5 * threshold(level)); }

double detection_power(double lambda, double rank, double freedom, double single_p) {
  using namespace boost::math;
  if (freedom < 1.0) return 0.0;       // its p-value is 1 (`log_p_value`)
  if (lambda == 0.0) return single_p;  // where the complement of Boost's noncentral F is wrong
  if (std::isinf(freedom)) {
    const double threshold = quantile(complement(chi_squared(rank), single_p));
    if (lambda > surely_found * threshold) return 1.0;
    return cdf(complement(non_central_chi_squared(rank, lambda), threshold));
  }
  const double threshold = quantile(complement(fisher_f(rank, freedom), single_p));
  if (lambda > surely_found * rank * threshold) return 1.0;
  return cdf(complement(non_central_f(rank, freedom, lambda), threshold));
}

double required_lambda(double rank, double freedom, double single_p, double power) {
  if (freedom < 1.0) return std::numeric_limits<double>::infinity();
  const auto excess = [&](double lambda) {
    return detection_power(lambda, rank, freedom, single_p) - power;
  };
  std::uintmax_t steps = 100;
  const auto root = boost::math::tools::bracket_and_solve_root(
      excess, 20.0, 2.0, true, boost::math::tools::eps_tolerance<double>(30), steps);
  return 0.5 * (root.first + root.second);
}

}  // namespace trueaxis::infer
