// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "trueaxis/calibration.hpp"

namespace trueaxis::calibrate_detail {

/// The mistake that the read-outs of axes most likely have: columns that differ by 5 mm or 5° and
/// more, as of columns in two units, or what is left of them thirty times their stated noise and
/// more than axes leave. Empty: none.
std::string read_out_mistake(std::span<const MachineMeasurement> data, const Calibration& found);

}  // namespace trueaxis::calibrate_detail
