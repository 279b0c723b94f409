// SPDX-License-Identifier: Apache-2.0
#include "support/command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

namespace trueaxis::testing {

CommandResult shell(const std::string& command) {
  CommandResult result;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    result.output.append(buffer, n);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

CommandResult trueaxis_command(const std::string& arguments) {
  return shell(places::command() + " " + arguments);
}

std::filesystem::path fresh_folder(const std::string& name) {
  std::filesystem::path folder = std::filesystem::path(places::scratch()) / name;
  if (const auto* test = ::testing::UnitTest::GetInstance()->current_test_info()) {
    std::string own = std::string(test->test_suite_name()) + "_" + test->name();
    std::ranges::replace_if(
        own, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    folder /= own;
  }
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json read_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(read_text(path));
}

}  // namespace trueaxis::testing
