// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "support/places.hpp"

/// A page of a report opened in headless Chromium, wide and on a phone.
namespace trueaxis::example {

inline bool can_open_pages() {
  const bool chromium = std::getenv("TRUEAXIS_CHROMIUM") ||
                        std::filesystem::exists("/usr/bin/chromium-headless-shell") ||
                        std::filesystem::exists("/usr/bin/chromium");
  return chromium && std::system("node --version >/dev/null 2>&1") == 0;
}

inline std::string read_page(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The folder of the pages' pictures as an argument, where the environment asks for pictures.
inline std::string pictures(const std::filesystem::path& folder) {
  return std::getenv("TRUEAXIS_PICTURES") ? " '" + folder.string() + "'" : "";
}

/// What report_page.mjs says of a page, and whether it finds it sound.
struct Opinion {
  bool sound = false;
  std::string log;
};

/// Opened with all its looks, or with the option `--folded`: wide and folded, for its banner.
inline Opinion open_page(const std::string& html, const std::string& name,
                         const std::string& option = "") {
  const std::filesystem::path folder = std::filesystem::path(places::scratch()) / "report" / name;
  std::filesystem::create_directories(folder);
  const std::filesystem::path page = folder / "report.html", log = folder / "log.txt";
  std::ofstream(page, std::ios::binary) << html;
  const std::string command = "node '" + places::source() + "/tests/e2e/report_page.mjs' '" +
                              page.string() + "' " + option + pictures(folder) + " >'" +
                              log.string() + "' 2>&1";
  const bool sound = std::system(command.c_str()) == 0;
  return {sound, read_page(log)};
}

}  // namespace trueaxis::example
