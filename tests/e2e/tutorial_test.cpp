// SPDX-License-Identifier: Apache-2.0
// Every command of docs/tutorial/first-axis.md, in its order in one folder: it ends with 0, and
// what shows below it is what it prints.
#include <fstream>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class Tutorial : public CommandTest {};

TEST_F(Tutorial, RunsAsPrinted) {
  std::istringstream page(read_text(places::source() + "/docs/tutorial/first-axis.md"));
  std::size_t commands = 0;
  std::istringstream printed;
  bool console = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      console = line == "```console";
      continue;
    }
    if (!console) continue;
    if (!line.starts_with("$ trueaxis ")) {
      std::string shown;
      ASSERT_TRUE(std::getline(printed, shown)) << line;
      EXPECT_EQ(shown, line);
      continue;
    }
    const CommandStreams result = command(line.substr(std::string("$ trueaxis ").size()));
    ASSERT_EQ(result.exit_code, 0) << line << '\n' << result.out << result.err;
    printed = std::istringstream(result.out);
    ++commands;
  }
  EXPECT_EQ(commands, 8U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "first/result/table.csv"));
}

// What a user has changed is never lost: init again says which files are in its way.
TEST_F(Tutorial, FilesToBeginWithAreNotWrittenTwice) {
  ASSERT_EQ(command("init -o first").exit_code, 0);
  std::ofstream(folder_ / "first/job.toml", std::ios::app) << "# mine\n";
  const std::string mine = read_text(folder_ / "first/job.toml");
  const CommandStreams again = command("init -o first");
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_NE(again.err.find("first/job.toml: is there and may hold your changes"),
            std::string::npos);
  EXPECT_EQ(read_text(folder_ / "first/job.toml"), mine);
}

}  // namespace
}  // namespace trueaxis::testing
