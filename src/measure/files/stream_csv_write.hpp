// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/outputs.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Writes `stream` so that read_stream_csv(write(stream)) is the same to the last bit (mm, rad).
/// The first line is a comment that names the schema. Readings of the virtual lathe have one of
/// their own: a command that simulates replaces them, and no measured ones.
void write_stream_csv(const ProbeStream& stream, OutputFile& sink,
                      const char* schema = "trueaxis.stream");

/// The same as a whole file at `path`; "-" is standard output.
void write_stream_csv(const ProbeStream& stream, const std::string& path);

}  // namespace trueaxis
