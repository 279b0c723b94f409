// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Writes `stream` so that read_stream_csv(write(stream)) is the same to the last bit (mm, rad).
/// The file is written beside and renamed, so no half-written file stays; "-" is standard output.
void write_stream_csv(const ProbeStream& stream, const std::string& path);

}  // namespace trueaxis
