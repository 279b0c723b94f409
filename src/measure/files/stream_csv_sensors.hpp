// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "measure/files/stream_csv_metadata.hpp"

namespace trueaxis {

/// Takes "0, 99, 202 deg" (or rad, rev) into `angles_rad`. @returns what is wrong and what to write
/// instead, empty where nothing is.
std::string csv_take_sensor_angles(std::string_view text, std::vector<double>& angles_rad);

/// What is wrong with the angles of sensors, in degrees, as a caller says them: two that are one,
/// radians. Empty where nothing is.
std::string csv_sensor_angles_trouble(std::span<const double> angles_deg);

/// The angles as the metadata say them.
std::string csv_sensor_angles_text(std::span<const double> angles_rad);

/// The sensors' angles of the metadata or the caller into the stream; a number of angles that is
/// not that of the columns, and sensors that this reader's caller cannot take, are diagnostics.
void csv_finish_sensors(const CsvHeader& header, const CsvKnownMetadata& known,
                        const StreamReadOptions& options, ProbeStream& stream,
                        CsvDiagnostics& diagnostics);

}  // namespace trueaxis
