// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.hpp"
#include "support/places.hpp"

/// The command with its two output streams apart, and what it left in a folder.
namespace trueaxis::testing {

struct CommandStreams {
  int exit_code = -1;
  std::string out, err;
};

/// A path for the shell, whatever it holds.
std::string shell_word(const std::filesystem::path& path);

/// Runs `trueaxis ARGUMENTS` in `folder`; standard input is empty unless ARGUMENTS redirect it. The
/// captured streams are kept next to the folder, so that the folder holds what the command wrote.
CommandStreams run_in(const std::filesystem::path& folder, const std::string& arguments);

/// Names of all files under `folder`, sorted.
std::vector<std::string> files_in(const std::filesystem::path& folder);

bool contains(const std::string& text, const std::string& part);

/// The first line of a text, without its end.
std::string first_line(const std::string& text);

}  // namespace trueaxis::testing
