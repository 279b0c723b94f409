// SPDX-License-Identifier: Apache-2.0
// The part of the following error that moves the axis of the cut, and what mends a table that an
// actuator cannot follow.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "correct/margin.hpp"
#include "format/reason_words.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

TargetSurface cylinder() {
  return {TargetKind::cylinder, false, 0.0, 4.0, 40.0, 0.0, 0.0, 0.0, 0.0};
}
AxisEstimate far_axis() { return {{0.15, 0.2, 0.0, 0.0, 0.0}, {}}; }

/// Order 1 of (displacement of the virtual lathe's servo − wanted) over one late turn.
double once_in_time_mm(const Correction& correction) {
  virtual_lathe::CutProgram program;
  program.target.start_mm = correction.target.z_start_mm;
  program.target.end_mm = correction.target.z_end_mm;
  program.target.radius_mm = correction.target.radius_mm;
  program.tool.feed_mm_per_rev = correction.tool.feed_mm_per_rev;
  program.tool.speed_rpm = correction.tool.speed_rpm;
  program.actuator.sampling_hz = correction.actuator.sampling_hz;
  program.actuator.delay_s = correction.actuator.delay_s;
  const CorrectionRows& rows = correction.rows;
  const virtual_lathe::CutPart part(program, {false, rows.revolution, rows.position_mm, rows.c_rad,
                                              rows.wanted_mm, rows.command_mm});
  const Profile profile(correction.axis.axis, correction.target, correction.tool);
  std::complex<double> once;
  constexpr int samples = 3600;
  for (int i = 0; i < samples; ++i) {
    const double turn = 15.0 + static_cast<double>(i) / samples, c = two_pi * turn;
    const double off =
        part.displacement_mm(c) - profile.at(c, correction.tool.feed_mm_per_rev * turn);
    once += 2.0 / samples * off * std::polar(1.0, -c);
  }
  return std::abs(once);
}

TEST(FollowingOnce, IsWhatTurnsWithThePartAndNotTheRippleOfTheHold) {
  for (const bool precompensate : {true, false}) {
    ToolSetup tool;
    tool.speed_rpm = 600.0;
    Actuator actuator;
    actuator.sampling_hz = 1970.0;  // 197 set-points per revolution: a ripple of 300 µm · π/197
    actuator.precompensate = precompensate;
    actuator.delay_s = 2e-4;
    const Correction correction = make_correction(far_axis(), cylinder(), tool, actuator);
    const double once = correction.margin.following_once_mm;
    EXPECT_NEAR(once, once_in_time_mm(correction), 1e-5) << precompensate;
    if (precompensate) {
      EXPECT_LT(once, 1e-7);
      EXPECT_GT(correction.margin.following_mm, 2e-4) << "the ripple is there";
    } else {
      EXPECT_GT(once, 0.005);
      EXPECT_LE(once, correction.margin.following_mm);
    }
  }
}

// Interpolation keeps sinc²(1/12) of the first harmonic: 1 − 0.9774 of 250 µm is 5.66 µm.
TEST(FollowingOnce, OfRowsIsWhatInterpolationTakes) {
  ToolSetup tool;
  tool.rows_per_revolution = 12;
  tool.speed_rpm = 60.0;
  Actuator actuator;
  actuator.natural_frequency_hz = actuator.sampling_hz = 1e9;
  actuator.precompensate = false;
  const double x = two_pi / 24.0, kept = std::pow(std::sin(x) / x, 2);
  EXPECT_NEAR(make_correction(far_axis(), cylinder(), tool, actuator).margin.following_once_mm,
              0.25 * (1.0 - kept), 2e-6);
}

// With 12 rows per revolution no speed below 5000 rpm works: it is the rows that are named, and
// they do.
TEST(Remedy, OfTooFewRowsIsRows) {
  ToolSetup tool;
  tool.rows_per_revolution = 12;
  const ActuatorMargin margin = make_correction(far_axis(), cylinder(), tool, {}).margin;
  ASSERT_FALSE(margin.follows);
  ASSERT_EQ(margin.remedies.size(), 1u);
  const Reason& remedy = margin.remedies.front();
  ASSERT_EQ(remedy.code, ReasonCode::follows_with_rows) << words_of(remedy);
  EXPECT_TRUE(remedy.parts.empty()) << "no speed would do";
  const int rows = static_cast<int>(remedy.number("rows")->value);
  tool.rows_per_revolution = rows;
  EXPECT_TRUE(make_correction(far_axis(), cylinder(), tool, {}).margin.follows);
  // Unfiltered, A (π/M)²/2 of 250 µm is 1 µm at M = 35; the actuator filters some of it.
  EXPECT_LE(rows, 35);
  tool.rows_per_revolution = rows - 1;
  EXPECT_FALSE(make_correction(far_axis(), cylinder(), tool, {}).margin.follows);
}

TEST(Remedy, OfTooFewSetPointsIsTheSamplingAndTheSpeed) {
  ToolSetup tool;
  Actuator actuator;
  actuator.sampling_hz = 500.0;
  const ActuatorMargin margin = make_correction(far_axis(), cylinder(), tool, actuator).margin;
  ASSERT_FALSE(margin.follows);
  ASSERT_EQ(margin.remedies.size(), 1u);
  const Reason& remedy = margin.remedies.front();
  ASSERT_EQ(remedy.code, ReasonCode::follows_with_set_points) << words_of(remedy);
  ASSERT_EQ(remedy.parts.size(), 1u);
  ASSERT_EQ(remedy.parts.front().code, ReasonCode::at_speed_or_less);
  const double hz = remedy.number("rate")->value;
  tool.speed_rpm = remedy.parts.front().number("speed")->value;
  EXPECT_TRUE(make_correction(far_axis(), cylinder(), tool, actuator).margin.follows);
  tool.speed_rpm = 600.0, actuator.sampling_hz = hz;
  EXPECT_TRUE(make_correction(far_axis(), cylinder(), tool, actuator).margin.follows);
}

TEST(Remedy, OfAStrokeThatIsTooSmallIsNone) {
  Actuator actuator;
  actuator.stroke_mm = 0.1;
  const Reasons remedies =
      make_correction(far_axis(), cylinder(), ToolSetup{}, actuator).margin.remedies;
  EXPECT_EQ(words_of(remedies, ", or "), "it can follow at no speed");
}

}  // namespace
}  // namespace trueaxis
