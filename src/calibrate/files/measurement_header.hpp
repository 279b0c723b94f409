// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "format/csv_text.hpp"
#include "trueaxis/calibration.hpp"

namespace trueaxis {

/// What `# key: value` lines say.
struct MeasurementMetadata {
  std::optional<MeasurementKind> kind;
  std::optional<double> noise;  ///< mm or rad
  bool noise_is_angle = false;
  std::optional<AxisName> axis;
  std::optional<int> gear_ratio;
  std::map<std::string, std::size_t> lines;  ///< by key
};

/// Reads a comment line; a comment that resembles a known key is a diagnostic.
void take_measurement_comment(std::string_view line, std::size_t number,
                              MeasurementMetadata& metadata, CsvDiagnostics& diagnostics);

enum class MeasurementRole {
  setup,
  ball,
  axis,
  deviation,
  length,
  along,
  command,
  actual,
  error,
  tool_length,
  time
};

struct MeasurementColumn {
  MeasurementRole role = MeasurementRole::setup;
  std::size_t index = 0;  ///< of the axis or the direction
  double factor = 1.0;    ///< to inside
  std::string name;
};

/// The columns of a header line, of which none is there twice, all with units of their kind, and
/// none that the kind needs is missing. Empty where something is wrong.
std::vector<MeasurementColumn> measurement_columns(std::string_view line, std::size_t number,
                                                   const MeasurementMetadata& metadata,
                                                   const Machine& machine,
                                                   CsvDiagnostics& diagnostics);

}  // namespace trueaxis
