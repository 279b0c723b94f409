// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

const std::string cut_data = std::string(TRUEAXIS_SOURCE) + "/data/five_axis/";
const std::string cut_scenario = "simulate " + cut_data + "cut.toml ";
const std::string to_compensate = "compensate " + cut_data + "example.nc --machine " + cut_data +
                                  "trunnion_ac.toml --errors " + cut_data +
                                  "trunnion_ac_errors.toml ";

class VirtualCutCommand : public CommandTest {
 protected:
  double of(const nlohmann::json& json) { return json.at("value"); }
};

TEST_F(VirtualCutCommand, PrintsWhatTheDocumentationShows) {
  const std::string page = read_text(fs::path(TRUEAXIS_SOURCE) / "docs/virtual_machine.md");
  const std::string start = "```console\n$ trueaxis ";
  const std::size_t begin = page.find(start), end = page.find("```", begin + start.size());
  ASSERT_NE(begin, std::string::npos);
  const std::string block = page.substr(begin + start.size(), end - begin - start.size());
  fs::create_directory_symlink(fs::path(TRUEAXIS_SOURCE) / "data", folder_ / "data");
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
  EXPECT_GT(of(before.at("off_at_ends").at("position")), 0.08);
  EXPECT_LT(of(after.at("off_at_ends").at("position")), 1.3e-4);
  for (const char* const part : {"position", "direction"})
    EXPECT_NEAR(of(after.at("off_at_ends").at(part)), of(said.at("error_after").at(part)), 1e-9);
  EXPECT_NEAR(of(after.at("off_between")), of(said.at("between_blocks").at("after")),
              0.01 * of(after.at("off_between")));
}

TEST_F(VirtualCutCommand, JudgesOneInPieces) {
  ASSERT_EQ(command(to_compensate + "-o c.nc --tolerance-um 2").exit_code, 0);
  const CommandStreams done =
      command(cut_scenario + "--program c.nc --json after.json -o path.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto after = result("after.json");
  EXPECT_EQ(after.at("block_ends"), 7);
  EXPECT_GT(after.at("moves"), 20);
  EXPECT_LT(of(after.at("off_between")), 2e-3);
  // Again with another step: its own results are replaced.
  EXPECT_EQ(command(cut_scenario + "--program c.nc --json after.json -o path.csv").exit_code, 0);
}

TEST_F(VirtualCutCommand, RefusesWhatItCannotCut) {
  file("p.nc", "G1 X0 Y0 Z1 A0 C0\nG2 X1 I1 F100\nG81 Z1\nX#1\nG1 B5 F100\nX1 X2\n");
  expect_input_error(cut_scenario + "--program p.nc -o path.csv", "p.nc:2: this control has no G2");
  const std::string err = command(cut_scenario + "--program p.nc -o path.csv").err;
  for (const char* const place : {"p.nc:1:", "p.nc:3:", "p.nc:4:", "p.nc:5:", "p.nc:6:"})
    EXPECT_TRUE(contains(err, place)) << place << '\n' << err;
  file("empty.nc", "");
  expect_input_error(cut_scenario + "--program empty.nc -o path.csv", "is no other form");
  file("other.nc", "F100\nG1 X0 Y0 Z0 A0 C0\nX1\n");
  expect_input_error(cut_scenario + "--program other.nc -o path.csv", "is no other form");
  expect_input_error(cut_scenario + "--program other.nc -o other.nc --force", "is an input");
  expect_input_error(cut_scenario + "--truth t.json -o path.csv", "leave --truth");
  expect_input_error(cut_scenario + "--seed 3 -o path.csv", "has no noise");
  expect_input_error("simulate " + cut_data + "ball.toml --program other.nc -o path.csv",
                     "--program needs");
  EXPECT_EQ(command("simulate " + cut_data + "ball.toml --json f.json -o path.csv").exit_code, 2);
  EXPECT_EQ(command("simulate " + cut_data + "ball.toml").exit_code, 2);
  EXPECT_EQ(command(cut_scenario + "--json f -o f").exit_code, 2);
}

}  // namespace
}  // namespace trueaxis::testing
