// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace trueaxis
