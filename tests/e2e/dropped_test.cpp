// SPDX-License-Identifier: Apache-2.0
// Files alone, as a desktop hands over what is dropped on the program.
#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

class Dropped : public CommandTest {
  void SetUp() override {
    CommandTest::SetUp();
    std::filesystem::create_directory(folder_ / "bench 7");
    file("bench 7/part.csv", csv(probe({.noise_mm = 0.002})));
  }
};

TEST_F(Dropped, AFileIsRunWithItsResultsNextToIt) {
  const CommandStreams dropped = command("'bench 7/part.csv'");
  const CommandStreams run = command("run 'bench 7/part.csv' -o 'bench 7/other_result'");
  EXPECT_EQ(dropped.exit_code, 0) << dropped.err;
  EXPECT_EQ(dropped.out.substr(0, dropped.out.find("report ")),
            run.out.substr(0, run.out.find("report ")));
  EXPECT_TRUE(there("bench 7/part_result/report.html"));
  EXPECT_EQ(read_text(folder_ / "bench 7/part_result/result.json"),
            read_text(folder_ / "bench 7/other_result/result.json"));
}

TEST_F(Dropped, OfSeveralFilesEachIsRunAndTheWorstExitCodeIsGiven) {
  file("empty.csv", "");
  EXPECT_EQ(command("empty.csv 'bench 7/part.csv'").exit_code, 3);
  EXPECT_TRUE(there("bench 7/part_result/report.html"));
  EXPECT_FALSE(there("empty_result"));
}

// A file may have the name of a command, and a word without such a file is a command.
TEST_F(Dropped, ACommandStaysACommand) {
  file("effects", "of the user");
  const CommandStreams listed = command("effects");
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_NE(listed.out.find("spindle.radial_synchronous"), std::string::npos);
  EXPECT_EQ(command("nowhere.csv").exit_code, 2);
  EXPECT_EQ(command("run 'bench 7/part.csv' nowhere.csv").exit_code, 2);
}

}  // namespace
}  // namespace trueaxis::testing
