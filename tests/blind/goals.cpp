// SPDX-License-Identifier: Apache-2.0
#include "blind/goals.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace trueaxis::blind {

double goal(Kind kind, PlanId plan) {
  switch (kind) {
    case Kind::null:
      return 0.99;
    case Kind::one:
    case Kind::gaps:
      return 0.97;
    case Kind::two:
    case Kind::unknown:
      return 0.95;
    case Kind::absorbed:
      return 0.98;
    case Kind::typical:  // too small to be named as often as none
      return 0.0;
    case Kind::three:  // given for one pass, P3 and P8; the plans between are taken as P3
      return plan == PlanId::p1 || plan == PlanId::p8 ? 0.93 : 0.88;
  }
  return 1.0;
}

std::size_t least_right(std::size_t cases, double goal_share) {
  const boost::math::binomial_distribution<> right(static_cast<double>(cases), goal_share);
  std::size_t least = 0;
  while (least < cases && cdf(right, static_cast<double>(least)) < test_level) ++least;
  return least;
}

Share share(std::size_t right, std::size_t cases) {
  using Binomial = boost::math::binomial_distribution<>;
  if (cases == 0) return {0.0, 0.0, 1.0};
  const double n = static_cast<double>(cases), k = static_cast<double>(right);
  return {k / n, right == 0 ? 0.0 : Binomial::find_lower_bound_on_p(n, k, 0.025),
          right == cases ? 1.0 : Binomial::find_upper_bound_on_p(n, k, 0.025)};
}

}  // namespace trueaxis::blind
