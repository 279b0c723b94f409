// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "nc/timed_turns.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::nc {
namespace {

Program read(const std::string& text) { return read_program(text, "p.nc", {}); }

std::string timed(const std::string& text, const std::vector<std::uint32_t>& lines) {
  return with_timed_turns(read(text), lines);
}

const std::string start = "G0 X1 Y1 Z1 A0 B0 C0\n";

// 90° at 360 °/min are a quarter of a minute; 30° and 40° together 50°.
TEST(NcTimedTurns, ATurnHasItsTimeAndTheNextBlockTheFeedOfBefore) {
  EXPECT_EQ(timed(start + "N1 G1 C90 F360\nN2 X2\nN3 X3\n", {1}),
            start + "N1 G93 G1 C90 F4.00000\nN2 G94 F360 X2\nN3 X3\n");
  EXPECT_EQ(timed(start + "G1X2F100\nA30B40\n(c)\nG0X3\n", {2}),
            start + "G1X2F100\nG93A30B40F2.00000\n(c)\nG94F100G0X3\n");
  EXPECT_EQ(timed(start + "G1 C90 F360\nO2\nN7\nN8 G4 P1\n", {1}),
            start + "G93 G1 C90 F4.00000\nO2\nN7\nN8 G94 F360 G4 P1\n");
}

TEST(NcTimedTurns, TurnsInARowSwitchOnce) {
  EXPECT_EQ(timed(start + "G94 G1 F360. C90\nC0 (back)\nG1 X2 F50\n", {1, 2}),
            start + "G93 G1 F4.00000 C90\nC0 F4.00000 (back)\nG94 G1 X2 F50\n");
}

// Where the next block may be skipped, the one after it says the feed as well.
TEST(NcTimedTurns, ABlockThatMayBeSkippedDoesNotCount) {
  EXPECT_EQ(timed(start + "G1 C90 F360\n/X2\nX3\nX4\n", {1}),
            start + "G93 G1 C90 F4.00000\n/G94F360X2\nG94F360X3\nX4\n");
}

TEST(NcTimedTurns, AModeOfItsOwnStays) {
  EXPECT_EQ(timed(start + "G1 C90 F360\nG93 X2 F7\n", {1}),
            start + "G93 G1 C90 F4.00000\nG93 X2 F7\n");
  EXPECT_EQ(timed(start + "G1 C90 F360\nG94 X2\n", {1}),
            start + "G93 G1 C90 F4.00000\nF360 G94 X2\n");
}

TEST(NcTimedTurns, WhatHasNoTimeIsRefused) {
  const auto refused = [](const std::string& text, std::uint32_t line) {
    try {
      timed(text, {line});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused(start + "G1 C90\n", 1).find("without an F"), std::string::npos);
  EXPECT_NE(refused(start + "G95 G1 C90 F1\n", 1).find("under G95"), std::string::npos);
  EXPECT_NE(refused("G1 X1 Y1 Z1 A0 B0 C90 F9\n", 0).find("not known"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis::nc
