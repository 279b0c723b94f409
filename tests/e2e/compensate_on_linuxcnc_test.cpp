// SPDX-License-Identifier: Apache-2.0
// What the interpreter of LinuxCNC (rs274, gcode) makes of programs before and after compensation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <regex>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/nc_programs.hpp"
#include "support/places.hpp"
#include "support/trunnion.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

class CompensateOnLinuxCnc : public CommandTest {
 protected:
  CommandStreams compensate(const std::string& name, const std::string& text,
                            const std::string& options) {
    file(name, text);
    return command("machine compensate " + name + " " + options);
  }
};

/// The calls of LinuxCNC's interpreter but the mark's: line numbers of the program and names, and
/// the moves.
std::vector<std::string> calls(const fs::path& folder, const std::string& program) {
  const auto done = shell("cd " + shell_word(folder) + " && rs274 -t tool.tbl -g " + program);
  EXPECT_EQ(done.exit_code, 0) << done.output;
  std::vector<std::string> out;
  std::istringstream lines(done.output);
  const std::regex call(R"(\s*\d+ (N\S+)\s+([A-Z_0-9]+)\(.*)");
  std::smatch found;
  for (std::string line; std::getline(lines, line);)
    if (!contains(line, "COMPENSATED BY TRUEAXIS") && std::regex_match(line, found, call))
      out.push_back(found[1].str() + ' ' + found[2].str());
  return out;
}

/// Without feeds and moves at them; LinuxCNC comments a change of the feed's mode.
std::vector<std::string> without_feeds(std::vector<std::string> list) {
  std::erase_if(list, [](const std::string& one) {
    return contains(one, "FEED") || contains(one, "COMMENT");
  });
  return list;
}

TEST_F(CompensateOnLinuxCnc, MakesTheSameCallsOfIt) {
  if (shell("command -v rs274").exit_code != 0) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  fs::copy_file(five_axis_data + "example.nc", folder_ / "p.nc");
  file("tool.tbl", "T1 P1 Z120 D1\n");
  ASSERT_EQ(command("machine compensate p.nc " + of_trunnion + "-o out.nc").exit_code, 0);
  const auto source = calls(folder_, "p.nc"), written = calls(folder_, "out.nc");
  EXPECT_GT(source.size(), 20u);
  EXPECT_EQ(written, source);
  // In pieces it makes more moves, before which a feed mode may be repeated, and nothing else.
  ASSERT_EQ(
      command("machine compensate p.nc " + of_trunnion + "-o pieces.nc --tolerance-um 2").exit_code,
      0);
  const auto pieces = calls(folder_, "pieces.nc");
  EXPECT_GT(pieces.size(), source.size());
  EXPECT_EQ(without_feeds(pieces), without_feeds(source));
}

TEST_F(CompensateOnLinuxCnc, MakesTheSameCallsOfRandomPrograms) {
  if (shell("command -v rs274").exit_code != 0) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  constexpr std::uint64_t seed = 78;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  ProgramMaker maker(seed);
  file("tool.tbl", "T1 P1 Z120 D1\n");
  // The numbers of these programs go further than the axes do.
  file("m.toml", std::regex_replace(read_text(five_axis_data + "trunnion_ac.toml"),
                                    std::regex("limits_[^\n]*"), ""));
  int compared = 0;
  while (compared < 8) {
    const CommandStreams done = compensate("p.nc", maker.next(25),
                                           "--machine m.toml --errors " + five_axis_data +
                                               "trunnion_ac_errors.toml -o out.nc --force");
    // A program may be refused for its skipped blocks, or for turns whose middle comes out worse.
    if (contains(done.err, "if the control skips line") ||
        contains(done.err, "Split its blocks (--tolerance-um)"))
      continue;
    ++compared;
    ASSERT_EQ(done.exit_code, 0) << done.err << pasted(read_text(folder_ / "p.nc"));
    const auto source = calls(folder_, "p.nc");
    EXPECT_GT(source.size(), 10u);
    const auto written = calls(folder_, "out.nc");
    EXPECT_EQ(std::ranges::count(written, "N..... STRAIGHT_FEED"),
              std::ranges::count(source, "N..... STRAIGHT_FEED"));
    // What turns rotary axes alone has its time, under another mode of the feed.
    const bool timed = contains(done.out, "G93 has the time");
    EXPECT_EQ(timed ? without_feeds(written) : written, timed ? without_feeds(source) : source)
        << pasted(read_text(folder_ / "p.nc"));
  }
  EXPECT_EQ(compared, 8);
}

// "G1 X100.0360 Y-50.0571 Z29.9684 A-35.00224 C70.04834 F1000 (" and ")" are 61 characters; with CR
// LF a line of 252 is the longest that LinuxCNC takes.
TEST_F(CompensateOnLinuxCnc, TakesTheLongestLine) {
  if (shell("command -v rs274").exit_code != 0) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  file("tool.tbl", "T1 P1 Z120 D1\n");
  const std::string words = "G1 X100. Y-50. Z30. A-35. C70. F1000 (";
  ASSERT_EQ(
      compensate("p.nc", words + std::string(190, 'c') + ")\r\nM2\r\n", of_trunnion + "-o out.nc")
          .exit_code,
      0);
  EXPECT_EQ(read_text(folder_ / "out.nc").find('\r'), 251u);
  EXPECT_FALSE(calls(folder_, "out.nc").empty());
  EXPECT_EQ(compensate("p.nc", words + std::string(191, 'c') + ")\r\nM2\r\n",
                       of_trunnion + "-o out.nc --force")
                .exit_code,
            3);
}

TEST_F(CompensateOnLinuxCnc, ReadsTheNumbersThatAreWritten) {
  if (shell("/usr/bin/python3 -c 'import gcode'").exit_code != 0)
    GTEST_SKIP() << "Python's gcode (linuxcnc) is not installed";
  const std::string source =
      "G90 G21\nG0 X0 Y0 Z0 A0 C0\nG1 X100. Y-50. F500\nZ30.\nG20 X3.5\nG21 A-35. C70.\nM2\n";
  ASSERT_EQ(compensate("p.nc", source, of_trunnion + "-o out.nc --decimals 12 --angle-decimals 12")
                .exit_code,
            0);
  const auto done = shell("cd " + shell_word(folder_) + " && /usr/bin/python3 " + places::source() +
                          "/tests/e2e/linuxcnc_moves.py out.nc x.var moves.txt");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  std::istringstream moves(read_text(folder_ / "moves.txt")),
      lines(without_comments(read_text(folder_ / "out.nc")));
  std::array<double, 6> words{};
  int compared = 0;
  double factor = 1.0;
  for (std::string line; std::getline(lines, line);) {
    if (contains(line, "G20")) factor = 25.4;
    if (contains(line, "G21")) factor = 1.0;
    bool is_move = false;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t at = line.find("XYZABC"[k]);
      if (at == std::string::npos) continue;
      words[k] = std::stod(line.substr(at + 1)) * (k < 3 ? factor : 1.0);
      is_move = true;
    }
    if (!is_move) continue;
    for (std::size_t k = 0; k < 6; ++k) {
      double end = 0.0;
      ASSERT_TRUE(moves >> end) << done.output;
      EXPECT_NEAR(end, words[k], 1e-9) << line << " axis " << k;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 5);
}

}  // namespace
}  // namespace trueaxis::testing
