// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
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

/// The folder of a plain page's pictures as an argument, where the environment asks for pictures.
inline std::string pictures(const std::filesystem::path& folder) {
  return std::getenv("TRUEAXIS_PICTURES") ? " '" + folder.string() + "'" : "";
}

/// What report_page.mjs says of a page, and whether it finds it sound.
struct Opinion {
  bool sound = false;
  std::string log;
};

/// One browser for all pages of a program: it opens them one after the other until the program
/// ends. It is asked by a pipe and answers by a named one.
class Browser {
 public:
  static Browser& of_all() {
    static Browser one;
    return one;
  }
  Opinion operator()(const std::filesystem::path& page, const std::string& option) {
    nlohmann::json words = nlohmann::json::array({page.string()});
    if (!option.empty()) words.push_back(option);
    if (std::getenv("TRUEAXIS_PICTURES")) words.push_back(page.parent_path().string());
    std::fprintf(asked_, "%s\n", words.dump().c_str());
    std::fflush(asked_);
    Opinion out;
    for (std::string line; std::getline(said_, line) && line != "--"; out.log += line + "\n")
      out.sound = line == "the report is sound";
    return out;
  }

 private:
  Browser() {
    const std::string answers =
        places::scratch() + "/browser_" + std::to_string(::getpid()) + ".pipe";
    ::mkfifo(answers.c_str(), 0600);
    asked_ = ::popen(
        ("node '" + places::source() + "/tests/e2e/report_page.mjs' --each >'" + answers + "' 2>&1")
            .c_str(),
        "w");
    said_.open(answers);
    std::filesystem::remove(answers);
  }
  ~Browser() { ::pclose(asked_); }
  Browser(const Browser&) = delete;

  std::FILE* asked_ = nullptr;
  std::ifstream said_;
};

/// Opened with all its looks, or with the option `--folded`: wide and folded, for its banner; or
/// with `--wide`: with all but the phone.
inline Opinion open_page(const std::string& html, const std::string& name,
                         const std::string& option = "") {
  const std::filesystem::path folder = std::filesystem::path(places::scratch()) / "report" / name;
  std::filesystem::create_directories(folder);
  const std::filesystem::path page = folder / "report.html";
  std::ofstream(page, std::ios::binary) << html;
  const Opinion out = Browser::of_all()(page, option);
  std::ofstream(folder / "log.txt") << out.log;
  return out;
}

}  // namespace trueaxis::example
