// SPDX-License-Identifier: Apache-2.0
#include "support/command_fixture.hpp"
#include "support/places.hpp"

/// Streams of nonsense with known truth (nonsense/, mathematics of its own): `fit`, `diagnose`,
/// `run` and `form` refuse each, say what they cannot see, or are right within 1.5 U.
namespace trueaxis::testing {
namespace {

class Nonsense : public CommandTest, public ::testing::WithParamInterface<int> {};

TEST_P(Nonsense, IsRefusedOrWithinU) {
  const auto done =
      shell("/usr/bin/python3 " + places::source() + "/tests/e2e/nonsense/judge.py " +
            shell_word(places::command()) + " --part " + std::to_string(GetParam()) + "/4");
  EXPECT_EQ(done.exit_code, 0) << done.output;
}

INSTANTIATE_TEST_SUITE_P(Quarter, Nonsense, ::testing::Range(0, 4));

}  // namespace
}  // namespace trueaxis::testing
