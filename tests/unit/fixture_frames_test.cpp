// SPDX-License-Identifier: Apache-2.0
// Every frame of a control: the lines of Table 1 of Hong & Yeh, and each format read back.
#include <gtest/gtest.h>

#include "fixture/files/controller_frames.hpp"
#include "support/random_fixture.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

Matrix4 of_table_1() {
  return times(Rx(0.1066 * rad_per_deg), Ry(-0.0217 * rad_per_deg), Rz(-0.0065 * rad_per_deg),
               Tr(-0.1819, 0.1141, -0.0663));
}

ControllerFrame frame_of(const std::string& format, const Matrix4& D, int decimals = 6) {
  for (const ControllerFrame& frame : controller_frames(transform(D), decimals))
    if (frame.format == format) return frame;
  ADD_FAILURE() << "no format " << format;
  return {};
}

TEST(FixtureFrames, TableOneToItsLastDigit) {
  const std::string at = "X-0.181862 Y0.114244 Z-0.066156";
  const std::vector<ControllerFrame> expected{
      {"fanuc.g68.2.p0", {"G68.2 " + at + " I-11.506192 J0.108786 K11.499672"}},
      {"fanuc.g68.2.p1.moving", {"G68.2 P1 Q123 " + at + " I0.106600 J-0.021700 K-0.006500"}},
      {"fanuc.g68.2.p1.fixed", {"G68.2 P1 Q123 " + at + " I0.106602 J-0.021688 K-0.006540"}},
      {"fanuc.g68.2.p2",
       {"G68.2 P2 Q0 X0 Y0 Z0 R0", "G68.2 P2 Q1 " + at,
        "G68.2 P2 Q2 X99.818130 Y0.102829 Z-0.028304",
        "G68.2 P2 Q3 X-0.170517 Y100.114070 Z0.119900"}},
      {"fanuc.g54.4", {'(' + at + " A0.106602 B-0.021688 C-0.006540)", "G54.4 P1"}},
      {"siemens.cycle800",
       {"CYCLE800(1,\"TC1\",0,57,-0.181862,0.114244,-0.066156,0.106600,-0.021700,-0.006500,"
        "0,0,0,-1,100,1)"}},
      {"siemens.frame", {"TRANS " + at, "AROT X0.106602 Y-0.021688 Z-0.006540"}},
      {"heidenhain.plane",
       {"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X-0.181862", "CYCL DEF 7.2 Y+0.114244",
        "CYCL DEF 7.3 Z-0.066156",
        "PLANE SPATIAL SPA+0.106602 SPB-0.021688 SPC-0.006540 TURN MB MAX FMAX SEQ- TABLE ROT"}}};
  const auto frames = controller_frames(transform(of_table_1()), 6);
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].format, expected[i].format);
    EXPECT_EQ(frames[i].lines, expected[i].lines) << frames[i].format;
  }
}

/// Numbers of half a unit of the last decimal: three lengths move a point by √3 of it, three angles
/// a corner of the cube at √3 · 100 mm; three points within 100 mm turn the frame by no more than
/// 4 of it over 100 mm. And rounding of doubles.
double bound_mm(const std::string& format, int decimals) {
  const double half = 0.5 * std::pow(10.0, -decimals), corner = std::sqrt(3.0) * 100.0;
  const double turned =
      format == "fanuc.g68.2.p2" ? 3.0 * 4.0 * half / 100.0 : 3.0 * half * rad_per_deg;
  return std::sqrt(3.0) * half + corner * turned + 1e-12;
}

void expect_read_back(const Matrix4& D, int decimals, const std::string& which) {
  for (const ControllerFrame& frame : controller_frames(transform(D), decimals)) {
    const double apart = frame_deviation_mm(read_controller_frame(frame), transform(D), 100.0);
    ASSERT_LE(apart, bound_mm(frame.format, decimals)) << frame.format << ", " << which << '\n'
                                                       << frame.lines.back();
    for (const std::string& line : frame.lines) {
      ASSERT_LT(line.size(), 256U);
      for (const char* minus_zero : {"-0.000000 ", "-0.000000,", "-0.000000)", "e-"})
        ASSERT_EQ(line.find(minus_zero), std::string::npos) << line;
    }
  }
}

TEST(FixtureFrames, EveryFormatIsReadBack) {
  constexpr unsigned seed = 1221;
  FixtureDraw draw(seed);
  for (int i = 0; i < 2000; ++i) {
    const double turn = i % 3 == 0 ? 3.0 : i % 3 == 1 ? 0.01 : 1e-7;  // 170°, 0.6°, 20 marcsec
    expect_read_back(draw.displacement(50.0, turn), 3 + i % 10, "seed 1221, " + std::to_string(i));
  }
}

TEST(FixtureFrames, PolesAreReadBack) {
  constexpr unsigned seed = 1222;
  FixtureDraw draw(seed);
  const double quarter = 90.0 * rad_per_deg;
  const auto some = [&] { return draw.within(-3.0, 3.0); };
  for (int i = 0; i < 200; ++i) {
    for (const double off : {0.0, 1e-16, 1e-12, 1e-9, 1e-6}) {
      const Matrix4 poles[] = {times(Rz(some()), Ry(quarter - off), Rx(some())),
                               times(Rz(some()), Ry(-quarter + off), Rx(some())),
                               times(Rx(some()), Ry(quarter - off), Rz(some())),
                               times(Rz(some()), Rx(off), Rz(some())),
                               times(Rz(some()), Rx(2.0 * quarter - off), Rz(some())),
                               Rz(some())};
      for (const Matrix4& R : poles)
        expect_read_back(times(Tr(draw.vector(5.0)), R), 9, "seed 1222, " + std::to_string(i));
    }
  }
  expect_read_back(unit_matrix(), 6, "no displacement");
  EXPECT_EQ(frame_of("fanuc.g68.2.p0", unit_matrix()).lines[0],
            "G68.2 X0.000000 Y0.000000 Z0.000000 I0.000000 J0.000000 K0.000000");
}

// A frame that is read by another convention is another frame: at 1° 31 µm at 100 mm.
TEST(FixtureFrames, ConventionsAreNotTheSame) {
  const Matrix4 D = times(Rx(rad_per_deg), Ry(rad_per_deg), Rz(rad_per_deg));
  ControllerFrame frame = frame_of("fanuc.g68.2.p1.moving", D);
  frame.format = "fanuc.g68.2.p1.fixed";
  EXPECT_GT(frame_deviation_mm(read_controller_frame(frame), transform(D), 100.0), 0.03);
  const Matrix4 expected = times(Rz(rad_per_deg), Ry(rad_per_deg), Rx(rad_per_deg));
  EXPECT_LT(difference(read_controller_frame(frame), expected), 1e-8);
}

// The words of each control, by matrices of the test: 10, 20, 30 in each format.
TEST(FixtureFrames, ReadersFollowTheirControls) {
  const double a = 10 * rad_per_deg, b = 20 * rad_per_deg, c = 30 * rad_per_deg;
  const Matrix4 shift = Tr(1, 2, 3), fixed = times(shift, Rz(c), Ry(b), Rx(a)),
                moving = times(shift, Rx(a), Ry(b), Rz(c));
  const std::string xyz = "X1 Y2. Z+3.0";
  const std::pair<ControllerFrame, Matrix4> cases[] = {
      {{"fanuc.g68.2.p0", {"G68.2 " + xyz + " I10 J20 K30"}}, times(shift, Rz(a), Rx(b), Rz(c))},
      {{"fanuc.g68.2.p1.moving", {"G68.2 P1 Q123 " + xyz + " I10 J20 K30"}}, moving},
      {{"fanuc.g68.2.p1.fixed", {"G68.2 P1 Q123 " + xyz + " I10 J20 K30"}}, fixed},
      {{"fanuc.g54.4", {"(" + xyz + " A10 B20 C30)", "G54.4 P1"}}, fixed},
      {{"siemens.cycle800", {"CYCLE800(1,\"TC1\",0,57,1,2,3,10,20,30,0,0,0,-1,100,1)"}}, moving},
      {{"siemens.frame", {"TRANS " + xyz, "AROT X10 Y20 Z30"}}, fixed},
      {{"heidenhain.plane",
        {"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+1", "CYCL DEF 7.2 Y+2", "CYCL DEF 7.3 Z+3",
         "PLANE SPATIAL SPA+10 SPB+20 SPC+30 TURN MB MAX FMAX SEQ- TABLE ROT"}},
       fixed},
      {{"fanuc.g68.2.p2",
        {"G68.2 P2 Q0 X0 Y0 Z0 R0", "G68.2 P2 Q1 X1 Y2 Z3", "G68.2 P2 Q2 X1 Y52 Z3",
         "G68.2 P2 Q3 X-6 Y9 Z3"}},
       times(shift, Rz(90.0 * rad_per_deg))}};
  for (const auto& [frame, expected] : cases)
    EXPECT_LT(difference(read_controller_frame(frame), expected), 1e-14) << frame.format;
}

TEST(FixtureFrames, OtherLinesAreRefused) {
  const ControllerFrame wrong[] = {
      {"fanuc.g68.2.p9", {""}},
      {"fanuc.g68.2.p0", {"G68.2 P1 X0 Y0 Z0 I0 J0 K0"}},
      {"fanuc.g68.2.p0", {"G68.2 X0 Y0 Z0 I0 J0"}},
      {"fanuc.g68.2.p0", {"G68.2 X0 Y0 Z0 I0 J0 K1e-3"}},
      {"fanuc.g68.2.p0", {"G68.2 X0 Y0 Znan I0 J0 K0"}},
      {"fanuc.g68.2.p1.fixed", {"G68.2 P1 Q321 X0 Y0 Z0 I0 J0 K0"}},
      {"fanuc.g68.2.p2", {"G68.2 P2 Q0 X0 Y0 Z0 R30", "", "", ""}},
      {"fanuc.g68.2.p2",
       {"G68.2 P2 Q0 X0 Y0 Z0 R0", "G68.2 P2 Q1 X0 Y0 Z0", "G68.2 P2 Q2 X1 Y0 Z0",
        "G68.2 P2 Q3 X2 Y0 Z0"}},
      {"fanuc.g54.4", {"(X0 Y0 Z0 A0 B0 C0)", "G54.4 P2"}},
      {"siemens.cycle800", {"CYCLE800(1,\"TC1\",0,27,0,0,0,0,0,0,0,0,0,-1,100,1)"}},
      {"siemens.frame", {"TRANS X0 Y0 Z0", "ROT X0 Y0 Z0"}},
      {"heidenhain.plane", {"CYCL DEF 7.0 DATUM SHIFT"}}};
  for (const ControllerFrame& frame : wrong)
    EXPECT_THROW(read_controller_frame(frame), InputError) << frame.lines[0];
}

}  // namespace
}  // namespace trueaxis::testing
