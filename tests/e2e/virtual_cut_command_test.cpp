// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/trunnion.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

const std::string cut_scenario = "machine simulate " + five_axis_data + "cut.toml ";
const std::string to_compensate =
    "machine compensate " + five_axis_data + "example.nc " + of_trunnion;

class VirtualCutCommand : public CommandTest {};

TEST_F(VirtualCutCommand, PrintsWhatTheDocumentationShows) {
  const std::string page =
      read_text(fs::path(places::source()) / "docs/reference/virtual-machine.md");
  const std::string start = "```console\n$ trueaxis ";
  const std::size_t begin = page.find(start), end = page.find("```", begin + start.size());
  ASSERT_NE(begin, std::string::npos);
  const std::string block = page.substr(begin + start.size(), end - begin - start.size());
  fs::create_directory_symlink(fs::path(places::source()) / "data", folder_ / "data");
  fs::create_directory(folder_ / "build");
  const CommandStreams done = command(first_line(block));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out, block.substr(block.find('\n') + 1));
  EXPECT_TRUE(read_text(folder_ / "build/cut.csv").starts_with("# schema: trueaxis.path/1\nline,"));
}

// Half of the last decimals is 0.05 um of three axes and 5e-6 deg of two at some 200 mm: 0.13 um.
TEST_F(VirtualCutCommand, JudgesACompensatedProgram) {
  ASSERT_EQ(command(to_compensate + "-o c.nc --json c.json").exit_code, 0);
  ASSERT_EQ(command(cut_scenario + "--json before.json").exit_code, 0);
  const CommandStreams done = command(cut_scenario + "--program c.nc --json after.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "c.nc: 8 moves, 7 block ends of ")) << done.out;
  const auto said = result("c.json"), before = result("before.json"), after = result("after.json");
  EXPECT_EQ(after.at("schema"), "trueaxis.cut/1");
  EXPECT_EQ(after.at("inputs").size(), 4u);
  EXPECT_EQ(before.at("inputs").size(), 3u);
  EXPECT_GT(value_of(before.at("off_at_ends").at("position")), 0.08);
  EXPECT_LT(value_of(after.at("off_at_ends").at("position")), 1.3e-4);
  for (const char* const part : {"position", "direction"})
    EXPECT_NEAR(value_of(after.at("off_at_ends").at(part)),
                value_of(said.at("error_after").at(part)), 1e-9);
  EXPECT_NEAR(value_of(after.at("off_between")), value_of(said.at("between_blocks").at("after")),
              0.01 * value_of(after.at("off_between")));
}

TEST_F(VirtualCutCommand, JudgesOneInPieces) {
  ASSERT_EQ(command(to_compensate + "-o c.nc --tolerance-um 2").exit_code, 0);
  const CommandStreams done =
      command(cut_scenario + "--program c.nc --json after.json -o path.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto after = result("after.json");
  EXPECT_EQ(after.at("block_ends"), 7);
  EXPECT_GT(after.at("moves"), 20);
  EXPECT_LT(value_of(after.at("off_between")), 2e-3);
  // Again with another step: its own results are replaced.
  EXPECT_EQ(command(cut_scenario + "--program c.nc --json after.json -o path.csv").exit_code, 0);
}

// Tools, work offsets, inches, inverse time, increments on the way home, axes and tip in one.
TEST_F(VirtualCutCommand, JudgesAProgramOfEverything) {
  std::string machine = read_text(five_axis_data + "trunnion_ac.toml");
  machine.insert(machine.find("[program]"),
                 "[workpiece.G55]\norigin_mm = [30, 5, -10]\nrotation_deg = [3, -4, 25]\n"
                 "zero = { X = 5, C = 30, A = -1 }\n[tools.1]\nlength_mm = 80\n[tools.2]\n"
                 "length_mm = 101.5\n");
  file("m.toml", machine);
  file("p.nc",
       "%\nO1 (MIX)\nG21 G90 G94 G17 G54\nT1 M6\nG43 H1\nG0 X10 Y0 Z50 A-30 C0\n"
       "G1 X20 Y5 F800\nG20 X1.5 Y.1\nG21 Z45 C10\nG93 A-35 F3\nX25 C15 F4\nG94 G55 G0 X10\n"
       "G1 Y5 C-10 F500\nG91 G28 Z0\nG90 T2 M6\nG43 H2 G54 G0 X0 Y0 Z40 A-20 C40\n"
       "G1 X10 F300 M8\n/X15 Y10\nG49\nG43.4 H2 X10 Y20 Z30 A-40 C20\nG1 X15 Y25 C30 F400\n"
       "A-50\nG91 G30 Z0\nM30\n%\n");
  file("cut.toml", "[machine]\nfile = \"m.toml\"\nerrors = \"" + five_axis_data +
                       "trunnion_ac_errors.toml\"\n[cut]\nprogram = \"p.nc\"\nstep_mm = 0.1\n"
                       "step_deg = 0.1\n");
  const CommandStreams made =
      command("machine compensate p.nc --machine m.toml --errors " + five_axis_data +
              "trunnion_ac_errors.toml -o out.nc --tolerance-um 3 --json said.json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  ASSERT_EQ(command("machine simulate cut.toml --json before.json").exit_code, 0);
  ASSERT_EQ(command("machine simulate cut.toml --program out.nc --json after.json").exit_code, 0);
  const auto said = result("said.json"), before = result("before.json"),
             after = result("after.json");
  EXPECT_EQ(after.at("block_ends"), 14);
  EXPECT_GT(after.at("moves"), 30);
  for (const char* const part : {"position", "direction"}) {
    const auto &was = before.at("off_at_ends").at(part), &is = after.at("off_at_ends").at(part);
    EXPECT_NEAR(value_of(was), value_of(said.at("error_before").at(part)), 1e-9);
    EXPECT_NEAR(value_of(is), value_of(said.at("error_after").at(part)), 1e-9);
    EXPECT_EQ(was.at("line"), said.at("error_before").at(part).at("line"));
  }
  EXPECT_NEAR(value_of(before.at("off_between")), value_of(said.at("between_blocks").at("before")),
              0.01 * value_of(before.at("off_between")));
  EXPECT_LT(value_of(after.at("off_between")), 1.01 * 3e-3);
}

TEST_F(VirtualCutCommand, RefusesWhatItCannotCut) {
  file("p.nc", "G1 X0 Y0 Z1 A0 C0\nG2 X1 F100\nG81 Z1\nX#1\nG1 B5 F100\nX1 X2\n");
  expect_input_error(cut_scenario + "--program p.nc -o path.csv", "p.nc:2: the arc has no centre");
  const std::string err = command(cut_scenario + "--program p.nc -o path.csv").err;
  for (const char* const place : {"p.nc:1:", "p.nc:3:", "p.nc:4:", "p.nc:5:", "p.nc:6:"})
    EXPECT_TRUE(contains(err, place)) << place << '\n' << err;
  file("empty.nc", "");
  expect_input_error(cut_scenario + "--program empty.nc -o path.csv", "is not another form");
  file("other.nc", "F100\nG1 X0 Y0 Z0 A0 C0\nX1\n");
  expect_input_error(cut_scenario + "--program other.nc -o path.csv", "is not another form");
  expect_input_error(cut_scenario + "--program other.nc -o other.nc --force", "is an input");
  EXPECT_EQ(command(cut_scenario + "--truth t.json -o path.csv").exit_code, 2);  // has no truth
  expect_input_error(cut_scenario + "--seed 3 -o path.csv", "has no noise");
  expect_input_error(
      "machine simulate " + five_axis_data + "ball.toml --program other.nc -o path.csv",
      "--program needs");
  EXPECT_EQ(command("machine simulate " + five_axis_data + "ball.toml").exit_code, 2);
  EXPECT_EQ(command(cut_scenario + "--json f -o f").exit_code, 2);
}

}  // namespace
}  // namespace trueaxis::testing
