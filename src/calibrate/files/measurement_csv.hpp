// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/calibration.hpp"

namespace trueaxis {

/// Reads a measurement on a machine (calibration.md): `# kind: ball`, a header that names
/// every column with its unit, rows in the order of measurement. @throws InputError with every
/// diagnostic: file, line, column, what to do.
MachineMeasurement read_measurement_csv(const std::string& path, const Machine& machine);

/// All files, or what is wrong with any of them.
std::vector<MachineMeasurement> read_measurements(const std::vector<std::string>& paths,
                                                  const Machine& machine);

}  // namespace trueaxis
