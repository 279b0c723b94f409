// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/guarded.hpp"
#include "cli/program.hpp"
#include "platform/terminal.hpp"

namespace trueaxis::cli {
namespace {

namespace fs = std::filesystem;

int run_file(const fs::path& file) {
  const fs::path folder = file.parent_path() / (file.stem().string() + "_result");
  const fs::path report = folder / "report.html";
  std::error_code error;
  const fs::file_time_type before = fs::last_write_time(report, error);  // of an earlier run
  const int code = guarded([&] {
    return run_program({"run", file.string(), "-o", folder.string()});
  });
  const fs::file_time_type after = fs::last_write_time(report, error);
  if (!error && after != before) platform::open_in_browser(report.string());
  return code;
}

}  // namespace

bool are_files(const std::vector<std::string>& words) {
  return !words.empty() && std::ranges::all_of(words, [](const std::string& word) {
    std::error_code error;
    return fs::path(word).has_extension() && fs::is_regular_file(word, error);
  });
}

int run_files(const std::vector<std::string>& files) {
  int code = done;
  for (const std::string& file : files) code = std::max(code, run_file(file));
  return code;
}

void keep_window_open() {
  if (!platform::terminal_is_own()) return;
  std::cerr << "\nEnter closes this window." << std::flush;
  std::cin.get();
}

}  // namespace trueaxis::cli
