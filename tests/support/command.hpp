// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "support/places.hpp"

/// Runs the trueaxis command as a user does: a process of its own, files in a folder of the test.
namespace trueaxis::testing {

struct CommandResult {
  int exit_code = -1;
  std::string output;  ///< standard output and error
};

CommandResult shell(const std::string& command);

CommandResult trueaxis_command(const std::string& arguments);

/// An empty folder under the build tree, made anew. Each test has its own: others run at the same
/// time.
std::filesystem::path fresh_folder(const std::string& name);

void write_text(const std::filesystem::path& path, const std::string& text);

std::string read_text(const std::filesystem::path& path);

nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace trueaxis::testing
