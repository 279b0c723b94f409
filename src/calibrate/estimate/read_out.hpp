// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trueaxis/calibration.hpp"

namespace trueaxis::calibrate_detail {

/// Position error of an axis: a polynomial of degree 3 at most and orders of a period that is
/// found, by least squares (Eq. 177).
AxisReadOut read_out_of(const MachineMeasurement& file, int max_orders);

/// For every file of kind axis: its read-out, parameters, and the error that follows. The zero of
/// the read-out has no part in it.
void from_read_outs(const Machine& machine, std::span<const MachineMeasurement> data,
                    const CalibrationOptions& options, Calibration& out);

}  // namespace trueaxis::calibrate_detail
