// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace trueaxis::cli {

/// A place to write to: any text but an empty one, which a script's empty variable gives.
inline CLI::Validator a_place() {
  return {[](const std::string& text) {
            return text.empty() ? std::string("is empty: name a place for the result")
                                : std::string();
          },
          "", "place"};
}

/// `--force`, the same for every command that writes.
inline CLI::Option* add_force(CLI::App& command, bool& force) {
  return command.add_flag("--force", force,
                          "replace files that are there and are not earlier results of this kind; "
                          "never one that is read");
}

}  // namespace trueaxis::cli
