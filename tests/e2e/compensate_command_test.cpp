// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

#include "support/command_fixture.hpp"
#include "support/nc_programs.hpp"
#include "support/places.hpp"
#include "support/trunnion.hpp"
#include "support/without_comments.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

const std::string machine = five_axis_data + "trunnion_ac.toml";
const std::string hole = "N10 G1 X100. Y-50. Z30. A-35. C70. F1000 (hole 3)\n";

class CompensateCommand : public CommandTest {
 protected:
  CommandStreams compensate(const std::string& name, const std::string& text,
                            const std::string& options) {
    file(name, text);
    return command("machine compensate " + name + " " + options);
  }
};

// A pipe is read once.
TEST_F(CompensateCommand, TheHashOfAMachineIsThatOfTheBytesThatWereRead) {
  const std::string errors = " --errors " + five_axis_data + "trunnion_ac_errors.toml -o out.nc ";
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(folder_ / "pipe") << read_text(machine); });
  const CommandStreams piped =
      compensate("p.nc", hole, "--machine pipe" + errors + "--json piped.json");
  writer.join();
  ASSERT_EQ(piped.exit_code, 0) << piped.err;
  ASSERT_EQ(
      command("machine compensate p.nc --machine " + machine + errors + "--json r.json --force")
          .exit_code,
      0);
  EXPECT_EQ(result("piped.json").at("inputs")[1].at("hash"),
            result("r.json").at("inputs")[1].at("hash"));
}

// The numbers of the worked example, nc.md and machine.md: machine, errors and results
// were worked out by hand there.
TEST_F(CompensateCommand, WritesTheWorkedExampleToTheByte) {
  const CommandStreams done = compensate("p.nc", hole, of_trunnion + "-o out.nc --json r.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(read_text(folder_ / "out.nc"),
            "N10 G1 X100.0360 Y-50.0571 Z29.9684 A-35.00224 C70.04834 F1000 (hole 3)\n");
  const auto json = result("r.json");
  EXPECT_EQ(json.at("schema"), "trueaxis.compensation/1");
  const std::map<std::string, double> change{{"X", 0.036035271450},
                                             {"Y", 0.057104763753},
                                             {"Z", 0.031559983647},
                                             {"A", 0.002238418994},
                                             {"C", 0.048338174086}};
  for (const auto& [axis, size] : change) {
    EXPECT_NEAR(value_of(json.at("largest_change").at(axis)), size, 1e-11) << axis;
    EXPECT_EQ(json.at("largest_change").at(axis).at("unit"), axis < "X" ? "deg" : "mm");
    EXPECT_EQ(json.at("largest_change").at(axis).at("line"), 1);
  }
  EXPECT_FALSE(json.at("largest_change").contains("B"));
  EXPECT_NEAR(value_of(json.at("about_tool_axis")), 0.001740449, 1e-9);
  const double before = std::hypot(0.014774302663, -0.017636984901, -0.006743673547);
  EXPECT_NEAR(value_of(json.at("error_before").at("position")), before, 1e-9);
  // Half of the last decimals, 0.05 um and 5e-6 deg at some 160 mm: less than 0.1 um in all.
  EXPECT_LT(value_of(json.at("error_after").at("position")), 1e-4);
  EXPECT_EQ(json.at("blocks"),
            (nlohmann::json{{"read", 1}, {"moved", 1}, {"rewritten", 1}, {"inserted", 0}}));
  // The two methods: 100.036036 and 100.036101 of X, and so on.
  EXPECT_NEAR(value_of(json.at("exact_minus_differential").at("X")), 65.692605e-6, 1e-10);
  EXPECT_NEAR(value_of(json.at("exact_minus_differential").at("C")), 3.279868e-6, 1e-10);
}

TEST_F(CompensateCommand, TakesTheDifferentialMethodAndTwelveDecimals) {
  const CommandStreams done =
      compensate("p.nc", hole,
                 of_trunnion + "-o out.nc --method differential --decimals 12 --angle-decimals 12");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string text = read_text(folder_ / "out.nc");
  const std::map<char, double> expected{{'X', 100.036100964055},
                                        {'Y', -50.057097679454},
                                        {'Z', 29.968446528073},
                                        {'A', -35.002237731207},
                                        {'C', 70.048341453954}};
  for (const auto& [letter, number] : expected)
    EXPECT_NEAR(std::stod(text.substr(text.find(letter) + 1)), number, 2e-12) << letter;
}

TEST_F(CompensateCommand, WithoutErrorsGivesTheSameBytes) {
  const std::string ugly =
      "\xEF\xBB\xBF%\r\n O0001(X1 G2)\r\n\r\ng0x1.y+2 z3.000a-0.c 5\r\nG1 X1.23456789F100;c\r\n%";
  const CommandStreams done = compensate("p.nc", ugly, "--machine " + machine + " -o out.nc");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(read_text(folder_ / "out.nc"), ugly);
}

TEST_F(CompensateCommand, ListsAllThatIsRefusedAtOnce) {
  file("p.nc", "G0 X0 Y0 Z0 A0 C0\nG2 X1 Y1 I1\nN7 X#1 B5\nG68.2 P1 X0\nG1 X1e3\n");
  expect_input_error("machine compensate p.nc " + of_trunnion + "-o out.nc --json r.json",
                     "p.nc:2:1: G2 is an arc");
  const std::string err = command("machine compensate p.nc " + of_trunnion + "-o out.nc").err;
  for (const char* const place : {"p.nc:2:1:", "p.nc:3:4:", "p.nc:3:8:", "p.nc:4:1:", "p.nc:5:4:"})
    EXPECT_TRUE(contains(err, place)) << place << '\n' << err;
}

TEST_F(CompensateCommand, WritesOnlyTheResultWhereALimitIsLeft) {
  // 400 mm is X's limit, and the errors ask for more.
  const CommandStreams done = compensate("p.nc", "G1 X0 Y0 Z0 A0 C0\nX400. A-35. C70.\n",
                                         of_trunnion + "-o out.nc --json r.json");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_TRUE(contains(done.err, "p.nc:2:")) << done.err;
  EXPECT_FALSE(there("out.nc"));
  const auto json = result("r.json");
  ASSERT_EQ(json.at("unreachable").size(), 1u);
  EXPECT_EQ(json.at("unreachable")[0].at("line"), 2);
  EXPECT_FALSE(json.at("unreachable")[0].at("why").get<std::string>().empty());
}

TEST_F(CompensateCommand, AtAPoleTheTipIsExactAndTheBlockIsListed) {
  // The tool along C: its direction off by B0C and the like needs a turn of C of any size.
  const CommandStreams done = compensate("p.nc", "G1 X50. Y20. Z30. A0. C10.\n",
                                         of_trunnion +
                                             "-o out.nc --json r.json --rotary all "
                                             "--decimals 12 --angle-decimals 12");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto json = result("r.json");
  ASSERT_EQ(json.at("singular").size(), 1u);
  EXPECT_EQ(json.at("singular")[0].at("line"), 1);
  EXPECT_LT(value_of(json.at("error_after").at("position")), 1e-9);
  EXPECT_NEAR(value_of(json.at("error_after").at("direction")),
              value_of(json.at("singular")[0].at("direction_left")), 1e-9);
  // Twenty times the angle that is corrected, at most.
  const double angle = value_of(json.at("error_before").at("direction"));
  for (const char* const axis : {"A", "C"})
    EXPECT_LE(value_of(json.at("largest_change").at(axis)), 20.0 * angle) << axis;
  // A is where a machine begins: the program does not move it.
  ASSERT_EQ(command("machine compensate p.nc " + of_trunnion + "-o still.nc").exit_code, 0);
  EXPECT_TRUE(contains(read_text(folder_ / "still.nc"), " A0. C10"))
      << read_text(folder_ / "still.nc");
}

TEST_F(CompensateCommand, ReplacesNoProgramUnasked) {
  file("out.nc", "(mine)\n");
  file("p.nc", hole + std::string("M30\n"));
  expect_input_error("machine compensate p.nc " + of_trunnion + "-o out.nc", "--force");
  expect_input_error("machine compensate p.nc " + of_trunnion + "-o p.nc --force", "is an input");
  EXPECT_EQ(command("machine compensate p.nc " + of_trunnion + "-o out.nc --force").exit_code, 0);
  EXPECT_TRUE(contains(read_text(folder_ / "out.nc"), "X100.0360"));
  // The same program again, with other numbers, needs no --force.
  EXPECT_EQ(command("machine compensate p.nc " + of_trunnion + "-o out.nc --decimals 6").exit_code,
            0);
  EXPECT_TRUE(contains(read_text(folder_ / "out.nc"), "X100.036035"));
  // Another version of the user's own program has other numbers as well, and no mark.
  std::string own = read_text(folder_ / "p.nc");
  file("out.nc", own.replace(own.find("X100"), 4, "X101"));
  expect_input_error("machine compensate p.nc " + of_trunnion + "-o out.nc", "--force");
  EXPECT_EQ(read_text(folder_ / "out.nc"), own);
}

TEST_F(CompensateCommand, LeavesFilesThatMayBeTheUsers) {
  file("out.nc.part2", "(the second part of the user's own program)\n");
  ASSERT_EQ(compensate("p.nc", hole, of_trunnion + "-o out.nc").exit_code, 0);
  EXPECT_TRUE(there("out.nc.part2"));
}

TEST_F(CompensateCommand, CutsBlocksWithinATolerance) {
  const CommandStreams done =
      compensate("p.nc", "G1 X100. Y-50. Z30. A-35. C70. F500\nX110. C75.\n",
                 of_trunnion + "-o out.nc --json r.json --tolerance-um 1");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto json = result("r.json");
  const auto& between = json.at("between_blocks");
  EXPECT_GT(value_of(between.at("before")), 0.1);
  EXPECT_LE(value_of(between.at("after")), 1e-3);
  const double inserted = json.at("blocks").at("inserted");
  EXPECT_GT(inserted, 3);
  EXPECT_LE(inserted + 1, std::ceil(1.3 * std::sqrt(value_of(between.at("before")) / 1e-3)));
}

// An error of a hundred waves a turn is nothing at every end of even pieces, and 20 µm between
// them: it was "off by 4e-11 µm at most" of a tolerance of 2 µm.
TEST_F(CompensateCommand, SeesAnErrorThatBendsBetweenItsPieces) {
  file("worm.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\nname = \"EYC\"\n"
       "kind = \"fourier\"\nterms_um = [[100, 0, 20]]\n");
  const CommandStreams done =
      compensate("p.nc", "T1 M6\nG0 X5 Y-10 Z30 A0 C0\nG1 Z20 C7200 F5000\nM30\n",
                 "--machine " + machine + " --errors worm.toml -o out.nc --tolerance-um 2");
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(contains(done.out + done.err, "more pieces")) << done.out << done.err;
}

// X0W alone takes the tip 100 µm off where line 5 leaves it, under "0.06 µm on the whole path".
TEST_F(CompensateCommand, TheFirstLineSaysWhatItDoesNotCount) {
  const CommandStreams done = compensate(
      "p.nc", "T1 M6\nG0 X1 Y1 Z1 A1 C1\nG91 G28 Z0\nT2 M6\nG90 G0 X5 Y6\nG1 Z3 F100\nX6\n",
      of_trunnion + "-o out.nc --json r.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string line = std::regex_replace(done.out, std::regex("\n +"), " ");
  EXPECT_FALSE(contains(line, "whole path")) << line;
  for (const char* const said : {"(1, from line 5)", "unknown position (1, from line 6)"})
    EXPECT_LT(line.find(said), line.find("next ")) << said << line;
  const auto reserved = result("r.json").at("reserved");
  ASSERT_EQ(reserved.size(), 2u);
  EXPECT_EQ(reserved[0].at("code"), "rapids_not_counted");
  EXPECT_EQ(reserved[1].at("code"), "ways_not_counted");
  EXPECT_EQ(value_of(reserved[1].at("numbers").at("line")), 6);
}

// A keeps what was right at C-100, and C what was right at A3.
TEST_F(CompensateCommand, TheFirstLineWarnsOfADirectionThatComesOutWorse) {
  const std::string text = "G0 X10 Y1 Z1 A3 C-100\nG0 A-30\nG1 X50 F100\n";
  CommandStreams done = compensate("p.nc", text, of_trunnion + "-o out.nc --json r.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string line = std::regex_replace(done.out, std::regex("\n +"), " ");
  EXPECT_LT(line.find("comes out worse"), line.find("next ")) << line;
  const auto json = result("r.json");
  ASSERT_EQ(json.at("reserved").size(), 1u);
  EXPECT_EQ(json.at("reserved")[0].at("code"), "direction_worse");
  EXPECT_EQ(json.at("reserved")[0].at("remedies")[0].at("code"), "correct_all_rotary");
  EXPECT_GT(value_of(json.at("error_after").at("direction")),
            1.5 * value_of(json.at("error_before").at("direction")));
  done = compensate("p.nc", text, of_trunnion + "-o all.nc --json all.json --rotary all");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(result("all.json").at("reserved").empty()) << done.out;
}

TEST_F(CompensateCommand, SaysWhichBlocksMayBeSkipped) {
  const CommandStreams done = compensate(
      "p.nc", "G1 X0 Y0 Z0 A0 C0 F500\n/3 X9 Y0 Z0 A0 C0\n/X10 Y0 Z0 A0 C0\nX1 Y2 Z0 A0 C0\n",
      of_trunnion + "-o out.nc --json r.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  for (const std::string& text : {done.out, result("r.json").at("remarks").dump()})
    EXPECT_NE(text.find("with block skip off, as 2 blocks that begin with '/' move axes or"),
              std::string::npos)
        << text;
}

// Without these blocks every position after them is another.
TEST_F(CompensateCommand, SaysWhichBlocksThatSetPositionsMayBeSkipped) {
  const std::string start = "G43 H1\nG1 X0 Y0 Z0 A0 C0 F500\n", end = "G1 X1 Y2 Z0 A0 C0\n";
  for (const auto& [block, said] : std::map<std::string, bool>{{"/G20", true},
                                                               {"/T2 M6", true},
                                                               {"/G43 H2", true},
                                                               {"/G18", true},
                                                               {"/G93 F2", true},
                                                               {"/M8", false},
                                                               {"/G0 F300", false},
                                                               {"/G54 G21 G90", false}}) {
    const std::string rest = block == "/G93 F2" ? "G1 X1 Y2 Z0 A0 C0 F2\n" : end;
    const CommandStreams done =
        compensate("p.nc", start + block + "\n" + rest, of_trunnion + "-o out.nc --force");
    ASSERT_EQ(done.exit_code, 0) << block << done.err;
    EXPECT_EQ(contains(done.out, "as 1 block that begins with '/' moves axes or"), said)
        << block << '\n'
        << done.out;
  }
}

TEST_F(CompensateCommand, RanksTheErrors) {
  ASSERT_EQ(compensate("p.nc", hole, of_trunnion + "-o out.nc --json r.json").exit_code, 0);
  const auto json = result("r.json");
  ASSERT_EQ(json.at("by_error").size(), 15u);
  double previous = 1e9;
  std::map<std::string, double> tip;
  for (const auto& one : json.at("by_error")) {
    EXPECT_LE(value_of(one.at("tip")), previous);
    previous = value_of(one.at("tip"));
    tip[one.at("name")] = previous;
  }
  // A shift moves the tip by itself; EXX is 30 um · 100/400.
  EXPECT_NEAR(tip.at("X0W"), 0.1, 1e-12);
  EXPECT_NEAR(tip.at("EXX"), 7.5e-3, 1e-12);
  EXPECT_NEAR(tip.at("EYC"), 3.498754496286e-3, 1e-12);
  // A0S turns the tip, 120 mm from the gauge point, by 20 urad.
  EXPECT_NEAR(tip.at("A0S"), 120.0 * 2.0 * std::sin(10e-6), 1e-12);
}

TEST_F(CompensateCommand, StatesUOfTheTipWhereTheErrorsHaveU) {
  file("e.toml",
       "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n[[error]]\nname = \"X0W\"\n"
       "value_um = 100\nu_um = 3\n[[error]]\nname = \"A0S\"\nvalue_urad = -20\nu_urad = 10\n");
  const CommandStreams done =
      compensate("p.nc", hole, "--machine " + machine + " --errors e.toml -o out.nc --json r.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  // 3 um along X, and 10 urad at the 120 mm from the gauge point to the tip; k = 2.
  EXPECT_NEAR(value_of(result("r.json").at("U")), 2.0 * std::hypot(3e-3, 240.0 * std::sin(5e-6)),
              1e-12);
  EXPECT_EQ(result("r.json").at("U").at("line"), 1);
}

TEST_F(CompensateCommand, PrintsWhatTheDocumentationShows) {
  const std::string page = read_text(fs::path(places::source()) / "docs/reference/nc.md");
  const std::string start = "```console\n$ trueaxis ";
  const std::size_t begin = page.find(start), end = page.find("```", begin + start.size());
  ASSERT_NE(begin, std::string::npos);
  const std::string block = page.substr(begin + start.size(), end - begin - start.size());
  fs::create_directory_symlink(fs::path(places::source()) / "data", folder_ / "data");
  fs::create_directory(folder_ / "build");
  const CommandStreams done = command(first_line(block));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out, block.substr(block.find('\n') + 1));
}

}  // namespace
}  // namespace trueaxis::testing
