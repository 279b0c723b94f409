// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "nc/arc.hpp"
#include "nc/program.hpp"
#include "support/nc_programs.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {
namespace {

using trueaxis::testing::xyzac;

constexpr const char* all = "G0 X0 Y0 Z0 A0 C0\n";  // a first line that says where the machine is

/// "line:column" of every diagnostic.
std::string places(const std::string& text, const ReadOptions& options = xyzac()) {
  std::string out;
  try {
    read_program(text, "p.nc", options);
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.diagnostics()) {
      EXPECT_EQ(one.file, "p.nc");
      EXPECT_FALSE(one.message.empty());
      out += (out.empty() ? "" : " ") + std::to_string(one.line) + ':' + std::to_string(one.column);
    }
  }
  return out;
}

struct RefusedCase {
  std::string text, where;  ///< after `all`, so the lines count from 2
};
void PrintTo(const RefusedCase& one, std::ostream* out) {
  *out << trueaxis::testing::pasted(one.text);
}

class NcRefused : public ::testing::TestWithParam<RefusedCase> {};

TEST_P(NcRefused, WithItsPlace) {
  EXPECT_EQ(places(all + GetParam().text), GetParam().where) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Codes, NcRefused,
    ::testing::Values(
        RefusedCase{"G91\nM8\nN5 X1\nY2\n", "4:4"}, RefusedCase{"G91 G53 Z0\n", "2:9"},
        RefusedCase{"G91 G28 Z0\nX1\nG90 G1 X1\n", "3:1 4:8"},
        RefusedCase{"G28 G91 Z0.\nG30 X0 Y0\nG0 X1 Y1 Z1 A1 C1\n", "4:4"},
        RefusedCase{"G2 X1 Y1 I1\n", "2:1"}, RefusedCase{"N1 G03 X1 Y1 R5\n", "2:4"},
        RefusedCase{"G84 X1 Z-5 R2 F100\nG81 Z-3 Q1 R1\n", "2:1 3:9"},
        RefusedCase{"G73 Z1 Q1\nG74 Z1\nG76 P1\nG85 Z1\nG89 Z1\n", "2:1 3:1 4:1 5:1 6:1"},
        RefusedCase{"G41 D1\nG42 D1\n", "2:1 3:1"}, RefusedCase{"G52 X1\n", "2:1"},
        RefusedCase{"G68 X0 Y0 R30\nG68.2 P1 X0\n", "2:1 3:1"},
        RefusedCase{"G92 X0\nG92.1\nG10 L2 P1 X0\n", "2:1 3:1 4:1"},
        RefusedCase{"M98 P1000\nG65 P9000\n", "2:1 3:1"}, RefusedCase{"M128\nM129\n", "2:1 3:1"},
        RefusedCase{"G33 Z1 K1\n", "2:1"}, RefusedCase{"G59.1\nG54.1 P3\n", "2:1 3:1"},
        RefusedCase{"M47\nN5 M99 P2\n", "2:1 3:8"}, RefusedCase{"M99\n", ""},
        RefusedCase{"M70\nG21\nM72\nM61 Q3\n", "2:1 4:1 5:1"}, RefusedCase{"G0 G1 X1\n", "2:4"}));

INSTANTIATE_TEST_SUITE_P(
    Words, NcRefused,
    ::testing::Values(RefusedCase{"X#1 Y[2+3] Z1e-3\n", "2:1 2:5 2:12"},
                      RefusedCase{"X#<a b> Y=2\n", "2:1 2:9"},
                      RefusedCase{"#100=5\nG1 X1\n", "2:1"}, RefusedCase{"X1 B5\nU1\n", "2:4 3:1"},
                      RefusedCase{"X1 X2\n", "2:4"}, RefusedCase{"X\n", "2:1"},
                      RefusedCase{"X1 2\n", "2:4"}, RefusedCase{"(\xC3\xA9) X1 Q2\n", "2:8"},
                      RefusedCase{"X1 (open\n", "2:4"}, RefusedCase{"X1 /Y2\n", "2:4"},
                      RefusedCase{"X1 \xC3\x9C\n", "2:4"}, RefusedCase{"G4 P1 X5\n", "2:7"},
                      RefusedCase{"X1 E5\n", "2:4"}, RefusedCase{"M6\n", "2:1"},
                      RefusedCase{"G43 H0\n", "2:5"}, RefusedCase{"M3.5\n", "2:1"}));

INSTANTIATE_TEST_SUITE_P(
    Positions, NcRefused,
    ::testing::Values(RefusedCase{"G1 G28 Z0\nX1\nX2\nZ1\nG30\nG1 A1\n", "3:1 7:4"},
                      RefusedCase{"G53 G0 Z0\nG1 X1 Y1\n", "3:4"},

                      RefusedCase{"G43 H1\nG1 X1\nZ1\nX2\n", "3:4"},
                      RefusedCase{"G43.4 X1 Y1 Z1\nG55\nG1 X1 Y1\nC3\n", "4:4"},
                      RefusedCase{"G43.4 H1\nG1 Z5\n", "3:4"},
                      RefusedCase{"T3 M6\n/X1 Y1\n", "3:2"}, RefusedCase{"M30\nX1\n", "3:1"},
                      RefusedCase{"O2\nG0 X1\n", "3:4"}));

TEST(NcReader, AxisWordsBeforeAMotionAndUnknownStart) {
  EXPECT_EQ(places("X1 Y1 Z1 A1 C1\n"), "1:1");
  EXPECT_EQ(places("G1 X1 Y1\nX2\nZ1 A0 C0\n"), "1:4");
  ReadOptions options = xyzac();
  options.start = {0.0, 0.0, 5.0, 0.0, std::nullopt, 0.0};
  EXPECT_EQ(places("G0 X1 Y1\nX2\nZ1\n", options), "");
  options.work_offsets[1] = false;
  options.tools = {1, 3};
  EXPECT_EQ(places("G54\nG55\nT2 M6\nT3 M6\nG43 H3\n", options), "2:1 3:4");
  EXPECT_EQ(places("G43 H1\nT3 M6\nG43 H1\nG43 H23\n", options), "1:5 3:5");
}

// Another tool has its tip elsewhere, and many machines change it at a position of their own: the
// new program took the axes there in a rapid move at the Z of before.
TEST(NcReader, AfterAnotherToolXYZAreNotKnown) {
  ReadOptions options = xyzac();
  for (const PositionMode mode : {PositionMode::axes, PositionMode::tip}) {
    options.mode = mode;
    EXPECT_EQ(places("T1 M6\nG0 X1 Y1 Z1 A1 C1\nT1 M6\nX2\n", options), "");
    EXPECT_EQ(places("T1 M6\nG0 X1 Y1 Z1 A1 C1\nT3 M6\nG1 X2\n", options), "4:4");
    EXPECT_EQ(places("T1 M6\nG0 X1 Y1 Z1 A1 C1\nT3 M6\nX2 Y2 Z2\n", options), "");
  }
}

TEST(NcReader, WordsInForceInMmAndRad) {
  const Program program = read_program(
      "G0 X1 Y2 Z3 A10 C-20\nG20 G1 X.5 F10\nN7 G93 C30 F2\nG21 T4 M6\nG43 H4 X12.7 Y2 Z7\nG43.4 "
      "H4 X1 Y1 "
      "Z1\n"
      "G56 G0 X9 Y9 Z9 A9 C9\n",
      "p.nc", xyzac());
  ASSERT_EQ(program.moves.size(), 6u);
  EXPECT_EQ(program.blocks, 7u);
  EXPECT_EQ(program.moves[1].words[0], 12.7);
  EXPECT_EQ(program.moves[1].words[3], 10 * rad_per_deg);
  EXPECT_EQ(program.moves[1].modal.motion, Motion::feed);
  EXPECT_TRUE(program.moves[1].modal.inch);
  EXPECT_TRUE(program.moves[1].sets);
  EXPECT_EQ(program.moves[2].words[0], 12.7);
  EXPECT_EQ(program.moves[2].words[5], 30 * rad_per_deg);
  EXPECT_EQ(program.moves[2].modal.feed_mode, FeedMode::inverse_time);
  EXPECT_EQ(program.moves[3].modal.tool, 4);
  EXPECT_EQ(program.moves[3].modal.length, LengthOffset::along_axis);
  EXPECT_EQ(program.moves[4].modal.length, LengthOffset::tip);
  EXPECT_EQ(program.moves[5].modal.work_offset, 2);
  EXPECT_FALSE(program.moves[0].continues);
  EXPECT_TRUE(program.moves[1].continues);
  EXPECT_FALSE(program.moves[3].continues) << "after a tool change";
}

// The machine stays where it is: its axes are word + zero before and after.
TEST(NcReader, AnotherWorkOffsetLeavesTheMachineWhereItIs) {
  ReadOptions options = xyzac();
  options.zeros[0] = {1.0, 2.0, 3.0, 0.1, 0.0, 0.2};
  options.zeros[1] = {10.5, 20.25, 30.0, 0.4, 0.0, 0.8};
  const Program program = read_program("G0 X1 Y2 Z3 A4 C5\nG55 X7\nG80\nG54 C1\n", "p.nc", options);
  ASSERT_EQ(program.moves.size(), 3u);
  const AxisValues &first = program.moves[0].words, &second = program.moves[1].words,
                   &third = program.moves[2].words;
  EXPECT_EQ(second[0], 7.0);
  for (const std::size_t k : {1, 2, 3, 5})
    EXPECT_NEAR(second[k] + options.zeros[1][k], first[k] + options.zeros[0][k], 1e-14) << k;
  EXPECT_NEAR(third[0] + options.zeros[0][0], 7.0 + options.zeros[1][0], 1e-14);
  EXPECT_EQ(third[5], 1.0 * rad_per_deg);
}

// The initial level is where the tool is, in words of the new offset: LinuxCNC goes to 53.
TEST(NcReader, ACycleBeginsInTheWorkOffsetOfItsBlock) {
  ReadOptions options = xyzac();
  options.zeros[1][2] = -3.0;
  const Program program =
      read_program("G0 X1 Y2 Z50 A4 C5\nG55 G81 X7 Z-5 R2\nX8\n", "p.nc", options);
  ASSERT_EQ(program.moves.size(), 9u);
  EXPECT_EQ(program.moves[1].words[2], 53.0);
  EXPECT_EQ(program.moves[4].words[2], 53.0);
  EXPECT_EQ(program.moves[8].words[2], 53.0);
}

// The initial level is of the machine on one control and a word on another.
TEST(NcReader, AWorkOffsetOfAnotherZWithinACycleIsRefused) {
  ReadOptions options = xyzac();
  options.zeros[1] = {10.0, 20.0, 0.0, 0.0, 0.0, 0.0};
  options.zeros[2][2] = -3.0;
  const std::string holes = "G0 X1 Y2 Z50 A4 C5\nG81 X7 Z-5 R2\n";
  EXPECT_EQ(places(holes + "G55 X8\n", options), "");
  EXPECT_EQ(places(holes + "G56 X8\nG54\n", options), "3:1 4:1");
  EXPECT_EQ(places(holes + "G80 G56\nG81 X8 Z-5 R2\n", options), "");
}

// Distances to a point on the way home are not positions; what follows is read under G90.
TEST(NcReader, GoesHomeUnderG91) {
  for (const char* const home :
       {"G91 G28 Z0\nG90\n", "G28 G91 Z0.\nG28 X0 Y0\nG90\n", "G91\nG30 Z5\nG90 "}) {
    const Program program =
        read_program(all + std::string(home) + "G0 X9 Y8 Z7 A6 C5\n", "p.nc", xyzac());
    ASSERT_EQ(program.moves.size(), 2u) << home;
    EXPECT_EQ(program.moves[1].words[2], 7.0);
    EXPECT_FALSE(program.moves[1].continues);
  }
}

TEST(NcReader, BehindTheSecondPercentIsNoProgram) {
  EXPECT_EQ(places("%\nG0 X1 Y1 Z1 A1 C1\n%\nfree text [#1]\n"), "");
  EXPECT_EQ(places("%\nG0 X1 Y1 Z1 A1 C1\n%\nfree text\n%\nG0 X2\nX3\n%\n"), "6:1");
}

/// Distance of the chords from the arc, and of their ends from it, by the arc's own equation.
TEST(NcReader, ChordsStayWithinTheArcTolerance) {
  ReadOptions options = xyzac();
  options.arc_tolerance_mm = 0.01;
  struct Case {
    std::string text;
    std::size_t u, v;
    double centre_u, centre_v, radius, turn_rad;
  };
  const Case cases[] = {
      {"G0 X10 Y0 Z0 A0 C0\nG3 X0 Y10 I-10 J0 F100\n", 0, 1, 0, 0, 10, 0.25 * two_pi},
      {"G0 X10 Y0 Z0 A0 C0\nG2 X0 Y10 Z6 C90 I-10 J0 F100\n", 0, 1, 0, 0, 10, 0.75 * two_pi},
      {"G0 X10 Y0 Z0 A0 C0\nG18 G2 X0 Z10 R10 F100\n", 2, 0, 0, 0, 10, 0.25 * two_pi},
      {"G0 X0 Y0 Z5 A0 C0\nG19 G3 Y5 Z0 R-5 F100\n", 1, 2, 0, 0, 5, 0.75 * two_pi},
      {"G0 X3 Y0 Z0 A0 C0\nG2 I-3 F100\n", 0, 1, 0, 0, 3, two_pi}};
  for (const Case& one : cases) {
    const Program program = read_program(one.text, "p.nc", options);
    const std::size_t chords = program.moves.size() - 1;
    const double step = one.turn_rad / static_cast<double>(chords);
    EXPECT_LE(one.radius * (1.0 - std::cos(0.5 * step)), 0.01 * (1.0 + 1e-9)) << one.text;
    // One chord less would be too far.
    const double longer = one.turn_rad / static_cast<double>(chords - 1);
    EXPECT_GT(one.radius * (1.0 - std::cos(0.5 * longer)), 0.01) << one.text;
    for (std::size_t i = 0; i < program.moves.size(); ++i) {
      const Move& move = program.moves[i];
      EXPECT_NEAR(std::hypot(move.words[one.u] - one.centre_u, move.words[one.v] - one.centre_v),
                  one.radius, 1e-12)
          << one.text << i;
      EXPECT_EQ(move.inserted, i != 0 && i != chords);
      if (i == 0) continue;
      const Move& before = program.moves[i - 1];
      const double length = std::hypot(move.words[one.u] - before.words[one.u],
                                       move.words[one.v] - before.words[one.v]);
      EXPECT_NEAR(length, 2.0 * one.radius * std::sin(0.5 * step), 1e-12) << one.text << i;
    }
  }
  const Program helix = read_program(cases[1].text, "p.nc", options);
  const std::size_t middle = helix.moves.size() / 2;
  const double s = static_cast<double>(middle) / static_cast<double>(helix.moves.size() - 1);
  EXPECT_NEAR(helix.moves[middle].words[2], 6.0 * s, 1e-12);
  EXPECT_NEAR(helix.moves[middle].words[5], 90.0 * s * rad_per_deg, 1e-12);
}

/// Height of a chord's arc over it: 2 r sin²(step/4), which has no difference of nearly equal
/// numbers in it.
TEST(NcReader, ChordsOfAFineToleranceStayWithinItToo) {
  for (const double tolerance_mm : {1e-10, 1.3e-10, 1.7e-10, 2.3e-10}) {
    const double radius_mm = 10.0;
    std::string trouble;
    Arc arc{.from = {radius_mm}, .to = {radius_mm}, .clockwise = false};
    arc.centre_mm[0] = -radius_mm;
    const auto way = ArcWay::of(arc, tolerance_mm, trouble);
    ASSERT_TRUE(way) << trouble;
    const double chords = way->chords();
    const auto height_mm = [&](double count) {
      const double sine = std::sin(0.25 * two_pi / count);
      return 2.0 * radius_mm * sine * sine;
    };
    EXPECT_LE(height_mm(chords), tolerance_mm * (1.0 + 1e-9));
    EXPECT_GT(height_mm(chords - 1.0), tolerance_mm * (1.0 - 1e-9));
  }
}

TEST(NcReader, AnArcOfMoreChordsThanAProgramHoldsIsRefused) {
  const Arc arc{.from = {}, .to = {100.0}, .clockwise = false, .radius_mm = 1e9};
  Arc round{.from = {1e9}, .to = {1e9}};
  round.centre_mm[0] = -1e9;
  for (const double tolerance_mm : {1e-4, 1e-8, 1e-300}) {
    std::string trouble;
    EXPECT_FALSE(ArcWay::of(round, tolerance_mm, trouble));
    EXPECT_NE(trouble.find("more than 1000000 chords"), std::string::npos) << tolerance_mm;
  }
  std::string trouble;
  const auto way = ArcWay::of(arc, 1e-4, trouble);
  ASSERT_TRUE(way) << trouble;
  EXPECT_LE(way->chords(), 2U);  // a straight line, nearly
  ReadOptions options = xyzac();
  options.arc_tolerance_mm = 1e-8;
  EXPECT_EQ(places("G0 X0 Y0 Z0 A0 C0\nG2 I-100000000 F100\n", options), "2:4");
}

TEST(NcReader, ArcsThatAreNone) {
  ReadOptions options = xyzac();
  options.arc_tolerance_mm = 0.01;
  EXPECT_EQ(places("G0 X10 Y0 Z0 A0 C0\nG3 X0 Y10 I-9 F100\nX5 Y5\nX20 R1\nX1 R50 I1\n", options),
            "2:4 3:1 4:1 5:1");
  EXPECT_EQ(places("G2 X1 Y1 Z1 A1 C1 I5\n", options), "1:4");
}

}  // namespace
}  // namespace trueaxis::nc
