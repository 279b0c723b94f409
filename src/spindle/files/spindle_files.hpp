// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "measure/files/stream_csv.hpp"
#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// A separation as a file says it.
struct SpindleJob {
  std::vector<std::string> streams;
  StreamReadOptions read;  ///< of every stream
  SpindleOptions options;
};

/// Reads
///
///     coverage_factor = 2   order_max = 100   sensitive_direction_deg   largest_condition
///     [sensor]   angles_deg = [0, 99, 202]   u_angle_deg   u_reindex_deg
///     [[stream]] stream = "one.csv"
///
/// @throws InputError with every diagnostic: file, line, column, what to do.
SpindleJob read_spindle_toml(const std::string& path);

/// The result as JSON (schema trueaxis.spindle/1): lengths in mm, angles in degrees.
std::string spindle_json(const SpindleResult& result, const SpindleOptions& options);

/// "0.826 ± 0.029 µm", or "at most 0.03 µm (95 %)".
std::string value_text(const Estimate& estimate, double k);

/// "12.3 ± 0.4 nm, 57°", or "suppressed".
std::string harmonic_text(const SpindleHarmonic& one, double k);

/// The values for a terminal; `verbose` adds a table of the orders.
std::string spindle_text(const SpindleResult& result, bool verbose);

/// Proposed angles of sensors, and those given (empty: none), with the orders that each suppresses.
std::string spindle_advice_text(std::span<const double> proposed_rad,
                                std::span<const double> given_rad, int order_min, int order_max,
                                double largest_condition);

/// One page that opens offline (schema trueaxis.spindle_report/1): the values of ISO 230-7 with
/// their U, polar plots of motion and form, and a table of the orders.
std::string spindle_page(const SpindleResult& result);

/// Polar plots (schema trueaxis.spindle_plot/1): motion along the sensitive direction, with what
/// does not repeat, over C; next to it the form of the part.
std::string polar_svg(const SpindleResult& result);

/// The same one by one, each a drawing of its own, without schema.
std::vector<std::string> polar_svgs(const ErrorMotion& motion, bool axial, double coverage_factor);

}  // namespace trueaxis
