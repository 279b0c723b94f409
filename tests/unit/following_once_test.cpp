// SPDX-License-Identifier: Apache-2.0
// The part of the following error that moves the axis of the cut, and what mends a table that an
// actuator cannot follow.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "correct/margin.hpp"
#include "format/reason_words.hpp"
#include "support/diagnosis_example.hpp"
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

// With 8 rows per revolution waves of order 7 and 9 look like waves of order 1, the first
// backwards; interpolation keeps sinc²(1/8) of them, and the actuator all.
TEST(FollowingOnce, OfWavesThatTheRowsMistakeIsTheirAmplitude) {
  ToolSetup tool;
  tool.rows_per_revolution = 8;
  tool.speed_rpm = 60.0;
  Actuator actuator;
  actuator.natural_frequency_hz = actuator.sampling_hz = 1e9;
  actuator.precompensate = false;
  const double x = two_pi / 16.0, kept = std::pow(std::sin(x) / x, 2);
  const std::complex<double> seventh(0.003, 0.001), ninth(-0.001, 0.002);  // cos + i sin
  const std::complex<double> axis(0.02, 0.05);
  const auto wave = [](double order, std::complex<double> size) {
    return RepeatingMotion{example::fitted("spindle.radial_synchronous", {.order = order},
                                           {size.real(), size.imag()})};
  };
  for (const bool both : {false, true}) {
    std::vector<RepeatingMotion> motions{wave(9.0, ninth)};
    if (both) motions.push_back(wave(7.0, seventh));
    const std::complex<double> once =
        kept * (std::conj(ninth) + (both ? seventh : 0.0)) - (1.0 - kept) * std::conj(axis);
    const AxisEstimate target{{axis.real(), axis.imag(), 0.0, 0.0, 0.0}, {}};
    const Correction made = make_correction(target, cylinder(), tool, actuator, motions);
    EXPECT_NEAR(made.margin.following_once_mm, std::abs(once), 1e-7);
  }
}

// Of a response that is known at few points: what straight lines and cubics between them differ by,
// of each order: an eccentricity e makes a mean and a second order of e²/4R. Precompensation leaves
// nothing else that turns with the part.
TEST(FollowingOnce, WhatThePointsOfTheResponseDoNotShowIsAdded) {
  ToolSetup tool;
  Actuator actuator;
  actuator.measured = {{15.0, 1.02, -0.1}, {40.0, 1.0, -0.3}, {90.0, 0.9, -0.9}};
  const double first = 0.25 * actuator.between_points(10.0);
  const double second =
      0.25 * 0.25 / 160.0 * (actuator.between_points(0.0) + actuator.between_points(20.0));
  ASSERT_GT(first, 1e-5);
  ASSERT_GT(second, 1e-7);
  const auto margin = [&] {
    return make_correction(far_axis(), cylinder(), tool, actuator).margin;
  };
  const ActuatorMargin found = margin();
  EXPECT_NEAR(found.following_unknown_mm, first + second, 0.01 * second);
  EXPECT_NEAR(found.following_once_mm, first, 1e-3 * first);
  EXPECT_GT(found.following_mm, found.following_unknown_mm);
  // The reason has it if the actuator would follow without it.
  const double rest = found.following_mm - found.following_unknown_mm;
  for (const double limit : {0.5 * (rest + found.following_mm), 0.5 * rest}) {
    actuator.following_limit_mm = limit;
    const Reasons breaks = margin().breaks;
    ASSERT_EQ(breaks.size(), 1u);
    EXPECT_EQ(breaks.front().code, ReasonCode::following_error_exceeded);
    EXPECT_EQ(breaks.front().number("unknown") != nullptr, limit > rest);
  }
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
  const Profile profile(far_axis().axis, cylinder(), tool);
  for (const auto& [rpm, said] : {std::pair{0.5, 1U}, {0.0, 0U}, {700.0, 0U}})
    EXPECT_EQ(trueaxis::remedy(Spectrum(profile), profile, actuator, rpm).parts.size(), said);
  tool.speed_rpm = remedy.parts.front().number("speed")->value;
  EXPECT_TRUE(make_correction(far_axis(), cylinder(), tool, actuator).margin.follows);
  tool.speed_rpm = 600.0, actuator.sampling_hz = hz;
  EXPECT_TRUE(make_correction(far_axis(), cylinder(), tool, actuator).margin.follows);
  actuator.sampling_hz = hz - 1.01 * 0.01 * 500.0;  // the next that was tried
  EXPECT_FALSE(make_correction(far_axis(), cylinder(), tool, actuator).margin.follows);
}

// It is rounded down, so that the actuator does follow; below 10 rpm to tenths.
TEST(Remedy, OfAStrokeIsASpeedThatIsRoundedDown) {
  ToolSetup tool;
  Actuator actuator;
  actuator.stroke_mm = 0.1;
  const Profile profile(far_axis().axis, cylinder(), tool);
  const Spectrum spectrum(profile);
  for (const auto& [rpm, said] : {std::pair{1234.9, 1234.0},
                                  {599.9, 599.0},
                                  {12.9, 12.0},
                                  {9.99, 9.9},
                                  {0.57, 0.5},
                                  {0.0, 0.0}}) {
    const Reason found = remedy(spectrum, profile, actuator, rpm);
    EXPECT_EQ(found.code, ReasonCode::follows_at_speed);
    ASSERT_EQ(found.parts.size(), 1u);
    EXPECT_EQ(found.parts.front().code, rpm == 0.0    ? ReasonCode::at_no_speed
                                        : rpm > 600.0 ? ReasonCode::at_speed
                                                      : ReasonCode::at_speed_or_less);
    if (rpm == 0.0) continue;
    EXPECT_EQ(found.parts.front().number("speed")->value, said);
  }
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
