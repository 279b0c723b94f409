// SPDX-License-Identifier: Apache-2.0
// The files that the tutorial begins with. Its commands are run by scripts/check_pages.
#include <fstream>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

class Tutorial : public CommandTest {};

// What a user has changed is never lost: init again says which files are in its way.
TEST_F(Tutorial, FilesToBeginWithAreNotWrittenTwice) {
  ASSERT_EQ(command("init first").exit_code, 0);
  std::ofstream(folder_ / "first/job.toml", std::ios::app) << "# mine\n";
  const std::string mine = read_text(folder_ / "first/job.toml");
  const CommandStreams again = command("init first");
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_NE(again.err.find("first/job.toml: is there and may hold your changes"),
            std::string::npos);
  EXPECT_EQ(read_text(folder_ / "first/job.toml"), mine);
}

}  // namespace
}  // namespace trueaxis::testing
