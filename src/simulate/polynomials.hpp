// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/math/special_functions/legendre.hpp>

namespace trueaxis::virtual_lathe {

/// Legendre polynomial P_l, also a little outside [−1, 1], where a probe may overrun.
inline double legendre(int degree, double u) {
  double before = 1.0, now = u;
  if (degree == 0) return before;
  for (int l = 1; l < degree; ++l) {
    const double next = boost::math::legendre_next(static_cast<unsigned>(l), u, now, before);
    before = now;
    now = next;
  }
  return now;
}

}  // namespace trueaxis::virtual_lathe
