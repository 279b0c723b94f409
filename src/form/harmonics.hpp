// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "form/trace.hpp"

namespace trueaxis::form {

/// One order of a closed trace, cos · cos nθ + sin · sin nθ.
struct Order {
  int order = 0;
  double cos_mm = 0.0, sin_mm = 0.0;
  double u_per_sigma = 0.0;  ///< standard uncertainty of either over that of one reading
  double amplitude_mm() const;
  double phase_rad() const;  ///< φ of amplitude · cos(nθ − φ), in [0, 2π)
};

/// Orders 0 … `order_max` by least squares over the readings at their true angles, together.
/// Eq. 267. @throws ContractViolation where there are not more readings than 2 order_max + 1
std::vector<Order> harmonics_of(const Trace& trace, int order_max);

}  // namespace trueaxis::form
