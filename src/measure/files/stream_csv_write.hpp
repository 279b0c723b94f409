// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/outputs.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Writes `stream` so that read_stream_csv(write(stream)) is the same to the last bit (mm, rad).
/// The first line is a comment that names the schema trueaxis.stream/1.
void write_stream_csv(const ProbeStream& stream, OutputFile& sink);

/// The same as a whole file at `path`; "-" is standard output.
void write_stream_csv(const ProbeStream& stream, const std::string& path);

}  // namespace trueaxis
