// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "nc/mark.hpp"
#include "nc/number_text.hpp"
#include "nc/writer.hpp"
#include "support/nc_programs.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {
namespace {

using trueaxis::testing::xyzac;

/// Writes a program with `change` (mm, deg) added to every position.
std::string moved(const std::string& text, AxisValues change, ReadOptions read = xyzac()) {
  const Program program = read_program(text, "p.nc", read);
  std::vector<NewPosition> positions;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    positions.push_back(
        {static_cast<std::uint32_t>(i), program.moves[i].inserted, program.moves[i].words});
    for (std::size_t k = 0; k < axis_count; ++k)
      positions.back().words[k] += change[k] * (is_rotary(k) ? rad_per_deg : 1.0);
  }
  WriteOptions options;
  options.axes = read.axes;
  return write_program(program, positions, options).text;
}

/// Writes a program of two moves with the second in `pieces`, each of them on the line.
std::string split(const std::string& text, int pieces) {
  const Program program = read_program(text, "p.nc", xyzac());
  WriteOptions options;
  options.axes = xyzac().axes;
  const auto last = static_cast<std::uint32_t>(program.moves.size() - 1);
  std::vector<NewPosition> positions;
  for (std::uint32_t i = 0; i < last; ++i) positions.push_back({i, false, program.moves[i].words});
  for (int j = 1; j <= pieces; ++j) {
    AxisValues words;
    for (std::size_t k = 0; k < axis_count; ++k)
      words[k] = program.moves[last - 1].words[k] +
                 (program.moves[last].words[k] - program.moves[last - 1].words[k]) * j / pieces;
    positions.push_back({last, j < pieces, words});
  }
  return write_program(program, positions, options).text;
}

// A post's usual way from tool to tool. X and Y are where the old program has them until the next
// block, which has all three positions.
TEST(NcWriter, ARapidWithAnUnknownAxisStaysAndTheNextBlockHasAllThatChanged) {
  const std::string text =
      "T1 M6\nG0 X1 Y1 Z1 A1 C1\nG91 G28 Z0\nT2 M6\nG90 G0 X5 Y6\nG43 H2 Z50\nX5 Y6 Z7\n";
  EXPECT_EQ(read_program(text, "p.nc", xyzac()).unknown_rapids.size(), 1u);
  EXPECT_EQ(moved(text, {0.5, 0, 0.25, 0, 0, 0}),
            "T1 M6\nG0 X1.5000 Y1 Z1.2500 A1 C1\nG91 G28 Z0\nT2 M6\nG90 G0 X5 Y6\n"
            "G43 H2 Z50.2500 X5.5000\nX5.5000 Y6 Z7.2500\n");
}

TEST(NcWriter, NumbersHaveNoExponentAndNoMinusZero) {
  const auto text = [](double value, int decimals) {
    std::string out;
    append_number(out, rounded(value, decimals), decimals);
    return out;
  };
  EXPECT_EQ(text(100.03603527145, 4), "100.0360");
  EXPECT_EQ(text(-1e-7, 4), "0.0000");
  EXPECT_EQ(text(-0.00006, 4), "-0.0001");
  EXPECT_EQ(text(1e-12, 12), "0.000000000001");
  EXPECT_EQ(text(123456789.0, 0), "123456789");
  EXPECT_EQ(text(0.1, 20), "0.10000000000000000555");
  EXPECT_EQ(rounded(2.5, 0), 2.0);  // halves to even, as the floating-point unit does
}

TEST(NcWriter, OnlyNumbersOfAxisWordsChange) {
  EXPECT_EQ(moved("N10 G1 X100. Y-50. Z30. A-35. C70. F1000 (hole 3)\r\n",
                  {0.03604, -0.0571, -0.03156, -0.002238, 0.0, 0.04834}),
            "N10 G1 X100.0360 Y-50.0571 Z29.9684 A-35.00224 C70.04834 F1000 (hole 3)\r\n");
  // More decimals stay; a value within half of the last decimal keeps its text.
  EXPECT_EQ(moved("g1x+1.y0.123456z 3a0c-0.(X9)", {0.00004, 0.00004, 1.0, 0, 0, 0}),
            "g1x+1.y0.123496z 4.0000a0c-0.(X9)");
  EXPECT_EQ(moved("G1 X+1 Y0.00001 Z0 A0 C0", {0.5, -0.00001, 0, 0, 0, 0}),
            "G1 X+1.5000 Y0.00000 Z0 A0 C0");
}

TEST(NcWriter, AxesWhoseOutputChangedAreAdded) {
  const std::string first = "G1 X1 Y2 Z3 A4 C5\n";
  const Program program =
      read_program(first + "F100 Z4\n(a) C9 (b)\nY2.5\nA5Y3\n", "p.nc", xyzac());
  WriteOptions options;
  options.axes = xyzac().axes;
  std::vector<NewPosition> positions;
  for (std::uint32_t i = 0; i < program.moves.size(); ++i)
    positions.push_back({i, false, program.moves[i].words});
  positions[1].words[0] += 0.001;
  positions[1].words[5] -= 0.01 * rad_per_deg;
  positions[2].words[0] += 0.001;
  positions[3].words[0] += 0.001;
  positions[4].words[2] += 0.1;
  EXPECT_EQ(write_program(program, positions, options).text,
            first + "F100 Z4 X1.0010 C4.99000\n(a) C9 (b)\nY2.5\nA5Y3X1.0000Z4.1000\n");
}

TEST(NcWriter, AnotherWorkOffsetAddsNoWords) {
  ReadOptions read = xyzac();
  read.zeros[1] = {0.1234567, 0.7654321, 0, 0.0123456, 0, 0};
  const std::string text = "G1 X1 Y2 Z3 A4 C5\nG55 X3\nY1\nG54 Z3\n";
  EXPECT_EQ(moved(text, {}, read), text);
  EXPECT_EQ(moved(text, {0.00001, 0.00001, 0.5, 0, 0, 0}, read),
            "G1 X1 Y2 Z3.5000 A4 C5\nG55 X3\nY1\nG54 Z3.5000\n");
}

TEST(NcWriter, InchesAreNoCoarserThanMillimetres) {
  EXPECT_EQ(moved("G20 G1 X1 Y1 Z1 A1 C1\n", {0.0254, 0, 0, 0, 0, 0}),
            "G20 G1 X1.001000 Y1 Z1 A1 C1\n");
}

TEST(NcWriter, PiecesAreLinesOfAxisWords) {
  const std::string first = "G1 X0 Y0 Z0 A0 C0 F100\r\n";
  EXPECT_EQ(
      split(first + "N20 X4 C8 (c)\r\n", 4),
      first + "X1.0000 C2.00000\r\nX2.0000 C4.00000\r\nX3.0000 C6.00000\r\nN20 X4 C8 (c)\r\n");
  EXPECT_EQ(split(first + "/N20X4F100", 2), first + "/X2.0000\r\n/N20X4F100");
  // What the block puts into force must be there before its first piece.
  EXPECT_EQ(split("G0 X0 Y0 Z0 A0 C0\nN20 G90 G1 X4 F50 S100 M3 M0\n", 2),
            "G0 X0 Y0 Z0 A0 C0\nG90 G1 F50 S100 M3 X2.0000\nN20 G90 G1 X4 F50 S100 M3 M0\n");
}

// A control skips `/3` by another switch than `/`: a line of the block goes with it.
TEST(NcWriter, LinesOfABlockAreSkippedWithIt) {
  const std::string first = "G0 X0 Y0 Z9 A0 C0 F100\n";
  EXPECT_EQ(split(first + "/3 G1 X4", 2), first + "/3G1 X2.0000\n/3 G1 X4");
  const std::string cycle = moved("G0 X0 Y0 Z9 A0 C0\n/3 G81 X1 Y2 Z-3 R1 F50\n", {0.5});
  EXPECT_EQ(cycle,
            "G0 X0.5000 Y0 Z9 A0 C0\n/3 G0 X1.5000 Y2 F50\n/3Z1.0000\n/3G1 Z-3.0000\n"
            "/3G0 Z9.0000\n");
}

/// A program with Y moved by 0.1 mm where X was moved.
std::string leaning(const std::string& text) {
  const Program program = read_program(text, "p.nc", xyzac());
  std::vector<NewPosition> positions;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    positions.push_back({static_cast<std::uint32_t>(i), false, program.moves[i].words});
    positions.back().words[0] += 1e-3 * program.moves[i].words[1];
    positions.back().words[1] += 1e-3 * program.moves[i].words[0];
  }
  WriteOptions options;
  options.axes = xyzac().axes;
  return write_program(program, positions, options).text;
}

TEST(NcWriter, NoNewWordMovesAnAxisThatASkippedBlockMoves) {
  const std::string first = "G1 X0 Y0 Z9 A0 C0 F100\n";
  // X is where its word says if it goes with the same switch, is moved back, or is named again.
  for (const char* sure : {"/X9\n/Y5\n", "/2 X9\n/2 X0\nY5\n", "/X9\nX8 Y5\nY6\n"})
    EXPECT_NO_THROW(leaning(first + sure)) << sure;
  for (const char* unsure : {"/X9\nY5\n", "/X9\n/2 Y5\n", "/2 X9\n/3 X0\nY5\n"}) {
    try {
      leaning(first + unsure);
      ADD_FAILURE() << unsure;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("give X in this block"), std::string::npos)
          << error.what();
    }
  }
}

// G64 without its P is another path; M3 without it another spindle.
TEST(NcWriter, PiecesKeepThePOfTheirCode) {
  const std::string written = split("G1 X0 Y0 Z0 A0 C0\nG64 P0.01 G1 X2 F500\n", 2);
  EXPECT_NE(written.find("G64 P0.01 G1 F500 X1"), std::string::npos) << written;
}

TEST(NcWriter, PiecesUnderInverseTimeShareTheTime) {
  EXPECT_EQ(split("G93\nG1 X0 Y0 Z0 A0 C0 F2\nN20 X3 F2.5\n", 3),
            "G93\nG1 X0 Y0 Z0 A0 C0 F2\nX1.0000 F7.5\nX2.0000 F7.5\nN20 X3 F7.5\n");
  EXPECT_EQ(split("G93 G1 X0Y0Z0A0C0F2\nX2F4.\n", 2), "G93 G1 X0Y0Z0A0C0F2\nX1.0000F8.\nX2F8.\n");
}

TEST(NcWriter, ArcsBecomeChords) {
  ReadOptions options = xyzac();
  options.arc_tolerance_mm = 3.0;  // 90 degrees of 10 mm in one chord, 180 in two
  EXPECT_EQ(
      moved("G0 X10 Y0 Z0 A0 C0\nN2 G02 X-10 Y0 I-10 J0 F50 (half)\nX10 I10\nG1 X0\n", {}, options),
      "G0 X10 Y0 Z0 A0 C0\nG01 F50 X0.0000 Y-10.0000\nN2 G01 X-10 Y0 F50 (half)\n"
      "X0.0000 Y10.0000\nX10 Y0.0000\nG1 X0\n");
}

// "G1 X1.5000 Y1 Z1 A1 C1 (" and ")" are 25 characters.
TEST(NcWriter, LinesStayWithin251Characters) {
  const std::string fits = "G1 X1 Y1 Z1 A1 C1 (" + std::string(226, 'c') + ")\n",
                    line = "G1 X1 Y1 Z1 A1 C1 (" + std::string(227, 'c') + ")\n";
  EXPECT_EQ(moved(line, {}), line);
  EXPECT_EQ(moved(fits, {0.5, 0, 0, 0, 0, 0}).size(), 252u);
  EXPECT_THROW(moved(line, {0.5, 0, 0, 0, 0, 0}), InputError);
  const std::string longer = "G1 X1 Y1 Z1 A1 C1 (" + std::string(400, 'c') + ")\n";
  EXPECT_EQ(moved(longer, {}), longer) << "what is not changed is the user's";
}

TEST(NcWriter, BlocksWithCodesThatMayRunOnceAreNotSplit) {
  for (const char* const code : {"M62 P1", "T2 M6", "M5", "M9"})
    EXPECT_THROW(split("G1 X0 Y0 Z0 A0 C0\nX1 Y0 Z0 " + std::string(code) + "\n", 2), InputError)
        << code;
  EXPECT_THROW(split("G93 G1 X0 Y0 Z0 A0 C0 F1\nX1\n", 2), InputError);
}

TEST(NcWriter, ACompensatedProgramIsKnownByWhatIsNoAxisWord) {
  const std::string source = "%\nN1 G1 X1 Y2 Z3 A4 C5 F9 (a)\nX3\nN2 Y3 M8\n";
  EXPECT_TRUE(differ_in_axis_words_only(moved(source, {0.1, 0.2, 0, 0, 0.3, 0}), source));
  EXPECT_TRUE(differ_in_axis_words_only(
      "%\nN1 G1 X1 Y2 Z3 A4 C5 F9 (a)\nX3\n/X2 Z4\nN2 Y3 X5.5 M8\n", source));
  EXPECT_FALSE(differ_in_axis_words_only("%\nN1 G1 X1 Y2 Z3 A4 C5 F9 (b)\nX3\nN2 Y3 M8\n", source));
  EXPECT_FALSE(differ_in_axis_words_only("(a letter to Grandmother)\n", source));
  EXPECT_FALSE(differ_in_axis_words_only("", ""));
}

}  // namespace
}  // namespace trueaxis::nc
