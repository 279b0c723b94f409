// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Rounding of a position that is on its limit: 1e-9 mm, 1e-9 deg.
double limit_slack(const MachineAxis& axis);

bool within(const MachineAxis& axis, double position);

/// Which axis would leave its limits, and where to; empty: none.
std::string outside_limits(const Machine& machine, const AxisPositions& axes);

struct PositionRange {
  double low = 0.0, high = 0.0;  ///< mm or rad
};
inline constexpr PositionRange everywhere{-std::numeric_limits<double>::infinity(),
                                          std::numeric_limits<double>::infinity()};

/// Where all errors of an axis are known: where each was measured, and a tenth of that range more.
PositionRange known_range(const ErrorModel& errors, AxisName axis);

/// Which axis would be further from where an error of it was measured than a tenth of that range,
/// and where to: what the error is there is not known. Empty: none.
std::string outside_known(const ErrorModel& errors, const AxisPositions& axes);

}  // namespace trueaxis
