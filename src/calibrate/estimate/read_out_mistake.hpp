// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "trueaxis/calibration.hpp"

namespace trueaxis::calibrate_detail {

/// The mistake that the read-outs of axes most likely have. Columns differ by 5 mm or 5° and more,
/// as with columns in two units, or their residuals are thirty times the stated noise and more than
/// axes leave. Empty: none.
std::string read_out_mistake(std::span<const MachineMeasurement> data, const Calibration& found);

}  // namespace trueaxis::calibrate_detail
