// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/units.hpp"

namespace trueaxis::layout {

/// "below 4.1 µm (95 % confidence)", rounded up.
std::string below(double value, const std::string& unit);

/// `plus_minus` for what is never below 0: "below 4.1 µm (95 % confidence)" if it is within its U,
/// of k = 2 at least.
std::string size_plus_minus(const Estimate& estimate, double coverage_factor, double scale,
                            const std::string& unit);

}  // namespace trueaxis::layout
