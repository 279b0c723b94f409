// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "trueaxis/error.hpp"

namespace trueaxis::cli {

/// A table stands where it was asked for only when it may be run: one of an earlier job goes.
/// @throws InputError when it stays.
inline void remove_earlier_table(const std::string& path) {
  std::error_code error;
  if (path == "-" || !std::filesystem::is_regular_file(path, error)) return;
  std::filesystem::remove(path, error);
  if (error) {
    throw InputError(path, "is of an earlier job and cannot be removed (" + error.message() +
                               "): do not run it");
  }
}

}  // namespace trueaxis::cli
