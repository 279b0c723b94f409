// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace trueaxis {

/// A file to begin with.
struct StarterFile {
  std::string_view name, text;
};

/// A scenario of a clamped shaft, the job of its stream, the scenario that cuts and probes it again
/// with the job's table, and a sweep: commented, and each runs as it is in their common folder.
std::span<const StarterFile> starter_files();

}  // namespace trueaxis
