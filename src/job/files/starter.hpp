// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A file to begin with.
struct StarterFile {
  std::string_view name, text;
};

/// A scenario of a clamped shaft, the job of its stream, the scenario that cuts and probes it again
/// with the job's table, and a sweep: commented, and each runs as it is in their common folder.
std::span<const StarterFile> starter_files();

/// A job that runs as it is, of the one stream at `path`, a reference for every seat in it, with
/// what else a job may say as comments.
std::string job_stub(const std::string& path, const ProbeStream& stream);

}  // namespace trueaxis
