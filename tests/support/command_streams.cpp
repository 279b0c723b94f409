// SPDX-License-Identifier: Apache-2.0
#include "support/command_streams.hpp"

namespace trueaxis::testing {

std::string shell_word(const std::filesystem::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

CommandStreams run_in(const std::filesystem::path& folder, const std::string& arguments) {
  const std::string captured = folder.string() + ".captured";
  const std::string out = captured + ".out", err = captured + ".err";
  const int status =
      std::system(("( cd " + shell_word(folder) + " && " + shell_word(places::command()) + " " +
                   arguments + " ) < /dev/null > " + shell_word(out) + " 2> " + shell_word(err))
                      .c_str());
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {exit_code, read_text(out), read_text(err)};
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_directory())
      names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace trueaxis::testing
