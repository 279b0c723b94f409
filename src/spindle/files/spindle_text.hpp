// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// The values for a terminal; `verbose` adds a table of the orders.
std::string spindle_text(const SpindleResult& result, bool verbose);

/// Proposed angles of sensors, and those given (empty: none), with the orders that each suppresses.
std::string spindle_advice_text(std::span<const double> proposed_rad,
                                std::span<const double> given_rad, int order_min, int order_max,
                                double largest_condition);

}  // namespace trueaxis
