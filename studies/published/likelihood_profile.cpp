// SPDX-License-Identifier: Apache-2.0
#include "studies/published/likelihood_profile.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

namespace trueaxis::study {
namespace {

constexpr double step_of_log = 0.15;
constexpr double half_chi_squared_95 = 0.5 * 3.841458820694124;  // χ²(1)
constexpr int bits = 24;

}  // namespace

LikelihoodProfile::LikelihoodProfile(const std::function<double(double)>& log_likelihood,
                                     double low, double high)
    : of_log_([log_likelihood](double x) { return log_likelihood(std::exp(x)); }),
      low_(std::log(low)),
      high_(std::log(high)) {
  double at = low_;
  highest_ = -std::numeric_limits<double>::infinity();
  for (double x = low_; x <= high_; x += step_of_log) {
    const double value = of_log_(x);
    if (value > highest_) highest_ = value, at = x;
  }
  const auto [x, less] = boost::math::tools::brent_find_minima(
      [this](double y) { return -of_log_(y); }, at - step_of_log, at + step_of_log, bits);
  best_ = std::exp(x);
  highest_ = -less;
}

/// Where the interval ends on the side of `step`.
double LikelihoodProfile::crossing(double step) const {
  const auto above = [this](double x) { return of_log_(x) - highest_ + half_chi_squared_95; };
  double inside = std::log(best_);
  for (double x = inside + step; x > low_ && x < high_; x += step) {
    if (above(x) > 0.0) {
      inside = x;
      continue;
    }
    const auto close = [](double a, double b) { return std::abs(a - b) < 1e-7; };
    const auto ends =
        boost::math::tools::bisect(above, std::min(inside, x), std::max(inside, x), close);
    return std::exp(0.5 * (ends.first + ends.second));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Ends LikelihoodProfile::interval_95() const {
  return {crossing(-step_of_log), crossing(step_of_log)};
}

}  // namespace trueaxis::study
