// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// One page that opens offline (schema trueaxis.spindle_report/1): the values of ISO 230-7 with
/// their U, polar plots of motion and form, and a table of the orders.
std::string spindle_page(const SpindleResult& result);

}  // namespace trueaxis
