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
inline std::string shell_word(const std::filesystem::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Runs `trueaxis ARGUMENTS` in `folder`; standard input is empty unless ARGUMENTS redirect it. The
/// captured streams are kept next to the folder, so that the folder holds what the command wrote.
inline CommandStreams run_in(const std::filesystem::path& folder, const std::string& arguments) {
  const std::string captured = folder.string() + ".captured";
  const std::string out = captured + ".out", err = captured + ".err";
  const int status =
      std::system(("( cd " + shell_word(folder) + " && " + shell_word(places::command()) + " " +
                   arguments + " ) < /dev/null > " + shell_word(out) + " 2> " + shell_word(err))
                      .c_str());
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {exit_code, read_text(out), read_text(err)};
}

/// Names of all files under `folder`, sorted.
inline std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_directory())
      names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The first line of a text, without its end.
inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace trueaxis::testing
