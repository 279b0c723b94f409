// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Gives the apex k of a cone its coverage interval, of value and covariance of the parameters
/// (Eq. 36a); surfaces without an apex, and an apex without value or u, stay as they
/// are. Without an interval stays too a k whose half angle is within `coverage_factor` u of zero.
void add_apex_interval(std::vector<FitParameter>& parameters, const Covariance& covariance,
                       double coverage_factor);

}  // namespace trueaxis
