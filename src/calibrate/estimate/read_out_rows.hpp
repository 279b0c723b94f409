// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "calibrate/estimate/problem.hpp"
#include "calibrate/estimate/read_out.hpp"

namespace trueaxis::calibrate_detail {

/// Whether an axis is along X, Y or Z. A read-out of any other shows a sum of errors, of which none
/// is told from the others.
bool is_along(const Machine& machine, AxisName axis);

/// A row a reading: actual less command, against a zero of the file's own, and a reversal
/// value of its own where none is an effect. Eq. 328.
void add_read_out(Problem& problem, const MachineMeasurement& file, std::size_t number,
                  bool with_reversal);

/// What it shows of the machine's errors, mm or rad.
double read_out_error(const Machine& machine, const ErrorModel& errors, const Row& row);

/// @throws InputError with every read-out that is along none of X Y Z
void check_directions(const Machine& machine, std::span<const MachineMeasurement> data);

/// Numbers that the fit of a read-out by itself has, its zero and reversal value among them.
std::size_t unknowns_of(const AxisReadOut& one);

/// Of a file of kind axis. @param read_outs of all these, in order
const AxisReadOut& read_out_of_file(std::span<const MachineMeasurement> data,
                                    std::span<const AxisReadOut> read_outs, std::size_t number);

/// σ of read-outs that state none becomes what their own fit leaves.
void take_noise(std::span<const MachineMeasurement> data, std::span<const AxisReadOut> read_outs,
                Problem& problem);

/// The position error of its axis, in the form in which the read-out by itself shows it.
void add_read_out_unknowns(const AxisReadOut& read_out, double largest,
                           std::vector<Unknown>& unknowns);

}  // namespace trueaxis::calibrate_detail
