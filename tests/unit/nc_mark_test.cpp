// SPDX-License-Identifier: Apache-2.0
// The mark of a compensated program is a comment in the words of the program, changes nothing else,
// and is found and taken off again.
#include <gtest/gtest.h>

#include "nc/mark.hpp"
#include "nc/program.hpp"
#include "support/nc_programs.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::nc {
namespace {

using trueaxis::testing::pasted;
using trueaxis::testing::ugly_programs;
using trueaxis::testing::xyzac;

// LinuxCNC carries out the last comment of a line alone: (MSG, ...) must stay the last.
TEST(NcMark, IsACommentOfTheFirstLineWithoutOne) {
  EXPECT_EQ(marked("%\r\nO1\r\nG1 X1\r\n%\r\n"),
            "%\r\nO1 (COMPENSATED BY TRUEAXIS)\r\nG1 X1\r\n%\r\n");
  EXPECT_EQ(marked("G1 X1"), "G1 X1 (COMPENSATED BY TRUEAXIS)");
  EXPECT_EQ(marked("G54\nG1 X1 ; rough\n"), "G54 ; COMPENSATED BY TRUEAXIS\nG1 X1 ; rough\n");
  EXPECT_EQ(marked("(MSG, A)\nG54 ; zero\nG1 X1\n"),
            "(MSG, A)\nG54 ; zero\nG1 X1 (COMPENSATED BY TRUEAXIS)\n");
  EXPECT_EQ(marked("G1 X1 (hole 3)\n"), "G1 X1 (hole 3)\n");
}

TEST(NcMark, IsFoundInSmallLettersToo) {
  EXPECT_EQ(marked_line("g54\n(compensated by TrueAxis)\n"), 2U);
  EXPECT_EQ(marked_line("g54\n(compensated by hand)\n"), std::nullopt);
}

TEST(NcMark, KeepsToTheLongestLine) {
  const std::string full = "(" + std::string(249, 'a') + ")\n";
  EXPECT_EQ(marked(full + "G54\n"), full + "G54 (COMPENSATED BY TRUEAXIS)\n");
}

// Whatever a program looks like, it reads as before, and the mark comes off again.
TEST(NcMark, ChangesNothingElse) {
  for (const std::string& text : ugly_programs()) {
    const std::string with = marked(text);
    EXPECT_EQ(without_mark(with), text) << pasted(text);
    EXPECT_EQ(marked_line(text), std::nullopt) << pasted(text);
    if (with == text) continue;  // there is no line for it
    EXPECT_TRUE(marked_line(with)) << pasted(with);
    try {
      const Program before = read_program(text, "p.nc", xyzac());
      const Program after = read_program(with, "p.nc", xyzac());
      ASSERT_EQ(after.moves.size(), before.moves.size()) << pasted(with);
      for (std::size_t i = 0; i < before.moves.size(); ++i)
        EXPECT_EQ(after.moves[i].words, before.moves[i].words) << pasted(with);
    } catch (const InputError& error) {
      EXPECT_TRUE(text.starts_with("G1X1Y1Z1A1C1(c)(d)X")) << pasted(text) << error.what();
    }
  }
}

TEST(NcMark, IsNotWhatMakesAnotherProgramOfIt) {
  EXPECT_TRUE(differ_in_axis_words_only("O1\nG1 X1\n", "O1 (COMPENSATED BY TRUEAXIS)\nG1 X2\n"));
  EXPECT_FALSE(differ_in_axis_words_only("O1\nG1 X1\n", "O2 (COMPENSATED BY TRUEAXIS)\nG1 X2\n"));
}

}  // namespace
}  // namespace trueaxis::nc
