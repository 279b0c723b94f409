// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "trueaxis/calibration.hpp"

namespace trueaxis::calibrate_detail {

/// The sense in which each position was approached, ±0.5: that of the step to it, or of the next
/// one if there is none. Empty: not both senses, or they have less than half of the range in
/// common.
std::vector<double> senses_of(const std::vector<double>& position);

/// The orders of a turn that a rotary axis' positions show: those of which half a wave is wider
/// than every gap, and those of its gear. Empty: it was not read all around.
std::vector<int> orders_of_turn(const std::vector<double>& position_rad,
                                std::optional<int> gear_ratio,
                                int max_orders = CalibrationOptions{}.max_orders);

inline constexpr double frequencies_a_width = 2.0;
/// Periods that the positions may show, of frequencies half a resolution width apart.
std::vector<double> periods_of(const std::vector<double>& position);

/// What a read-out sees of an error along X Y Z (a rotary axis: about them): its own direction,
/// with the sign of errors.
std::array<double, 3> read_out_factors(const MachineAxis& axis, ErrorSign sign);

/// What a read-out of an axis shows of a machine's errors, mm or rad. Eq. 328.
double read_out_error(const MachineAxis& axis, const ErrorModel& errors, double position);

/// Position error of an axis: a polynomial of degree 3 at most and orders of a period that is
/// found, by least squares (Eq. 177). @param known of the machine already, which is subtracted
AxisReadOut read_out_of(const MachineMeasurement& file, int max_orders,
                        const std::function<double(double)>& known = {});

/// Every file of kind axis by itself, and the error that follows, without the zero, where its
/// readings are not rows of a problem with a tip: read-outs alone, axes along none of X Y Z.
void from_read_outs(const Machine& machine, std::span<const MachineMeasurement> data,
                    const CalibrationOptions& options, Calibration& out);

}  // namespace trueaxis::calibrate_detail
