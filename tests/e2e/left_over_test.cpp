// SPDX-License-Identifier: Apache-2.0
// What a killed run leaves beside its results, the next one takes away, and nothing else.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

class LeftOver : public CommandTest {};

TEST_F(LeftOver, OfAKilledRunGoesWithTheNext) {
  file("part.csv", csv(probe({.noise_mm = 0.002})));
  const std::string begun = "{\n  \"schema\": \"trueaxis.fit/1\",\n  \"sta";
  file("f.json.part999999", begun);  // killed while it wrote
  file("f.json.part4_", "");         // killed before
  file("f.json.part1", "of an archive of the user");
  file("f.json.partly", begun);  // not the naming of a run
  file("f.json.part77", begun);  // another run is writing it
  const int held = ::open((folder_ / "f.json.part77").c_str(), O_RDONLY);
  ASSERT_EQ(::flock(held, LOCK_EX | LOCK_NB), 0);

  const CommandStreams done = command("fit part.csv --surface cylinder --json f.json");
  ::close(held);

  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(files_in(folder_), (std::vector<std::string>{"f.json", "f.json.part1", "f.json.part77",
                                                         "f.json.partly", "part.csv"}));
}

// The stream of a diagnosis has the name and the schema of one that was left over.
TEST_F(LeftOver, WhatIsReadIsKept) {
  file("part.toml",
       shaft_with("id = \"part.roundness\"\norder = 3\namplitude_um = 5\n", "1", 30.0, 25.0, 1));
  ASSERT_EQ(command("simulate part.toml -o s.csv.part1").exit_code, 0);
  ASSERT_EQ(command("diagnose s.csv.part1 --surface cylinder --json d.json").exit_code, 0);
  const CommandStreams done = command("simulate --from d.json -o s.csv");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(there("s.csv"));
  EXPECT_TRUE(there("s.csv.part1"));
}

}  // namespace
}  // namespace trueaxis::testing
