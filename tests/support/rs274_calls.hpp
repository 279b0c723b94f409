// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/command_streams.hpp"
#include "support/part_streams.hpp"

namespace trueaxis::testing {

/// A call of LinuxCNC's interpreter to the machine, mm and degrees.
struct Call {
  std::string name;
  double x = 0.0, z = 0.0, c = 0.0;
  double feed = 0.0;    ///< in force
  std::string words{};  ///< of LOG and LOGOPEN
};

inline bool has_interpreter() { return shell("command -v rs274").exit_code == 0; }

/// Those of a program that starts at X 100 Z 60.
inline std::vector<Call> interpreted(const std::filesystem::path& folder,
                                     const std::string& program) {
  write_text(folder / "from.ngc", "G21 G0 X100 Z60\n" + read_text(folder / program));
  const auto done = shell("cd " + shell_word(folder) + " && rs274 -g from.ngc");
  EXPECT_EQ(done.exit_code, 0) << done.output;
  const std::regex move(
      R"(.*(STRAIGHT_[A-Z]+)\(([-\d.]+), [-\d.]+, ([-\d.]+), [-\d.]+, [-\d.]+, ([-\d.]+)\))");
  const std::regex mode(R"x(.*SET_MOTION_CONTROL_MODE\((\w+)\))x");
  const std::regex rate(R"(.*SET_FEED_RATE\(([\d.]+)\))"), log(R"x(.* (LOG|LOGOPEN)\("(.*)"\))x");
  std::vector<Call> out;
  std::istringstream lines(done.output);
  std::smatch found;
  double feed = 0.0;
  std::string path;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, rate)) feed = std::stod(found[1]);
    if (std::regex_match(line, found, mode)) path = found[1];
    if (std::regex_match(line, found, move))
      out.push_back(
          {found[1], std::stod(found[2]), std::stod(found[3]), std::stod(found[4]), feed});
    else if (std::regex_match(line, found, log))
      out.push_back({found[1], 0.0, 0.0, 0.0, feed, found[2]});
  }
  EXPECT_EQ(path, "CANON_EXACT_PATH");  // a corner that is rounded is not clear
  return out;
}

inline std::size_t count(const std::vector<Call>& all, const std::string& name) {
  return static_cast<std::size_t>(
      std::ranges::count(all, name, [](const Call& one) { return one.name; }));
}

}  // namespace trueaxis::testing
