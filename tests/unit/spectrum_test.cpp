// SPDX-License-Identifier: Apache-2.0
// Harmonics of a profile along the cut, as an actuator is to follow them.
#include "correct/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "correct/profile.hpp"
#include "support/diagnosis_example.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// An axis 0.3 mm off and tilted by 8 µm/mm: what goes with the square of the eccentricity is curved
// along Z, and the slope is that of the value by central differences. Over 2 µm these err by the
// third derivative times 2e-7 mm², below 1e-9 here; 1e-16 mm of rounding over 2e-3 mm is nothing.
TEST(Spectrum, SlopeIsTheDerivativeOfTheValue) {
  ToolSetup tool;
  tool.feed_mm_per_rev = 0.5;
  const Spectrum spectrum(Profile(
      Axis{0.30, 0.0, 0.0, 8e-3, 0.0},
      {.kind = TargetKind::cylinder, .z_start_mm = 0, .z_end_mm = 40.0, .radius_mm = 8.0}, tool));
  ASSERT_GE(spectrum.orders().size(), 3u);  // mean, eccentricity and what goes with its square
  constexpr double step_mm = 1e-3;
  std::vector<SlowAmplitude> before, at, after;
  for (const double share : {0.1, 0.5, 0.9}) {
    const double z = spectrum.start_mm() + share * (spectrum.end_mm() - spectrum.start_mm());
    spectrum.at(z - step_mm, before);
    spectrum.at(z, at);
    spectrum.at(z + step_mm, after);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto slope = (after[i].value - before[i].value) / (2.0 * step_mm);
      EXPECT_LT(std::abs(at[i].slope - slope), 1e-9) << spectrum.orders()[i] << " at " << z;
    }
  }
}

// A cos nC + B sin nC in the angle ψ of the cut, C = c_start ± ψ: a_n = (A ∓ iB) e^(±i n c_start).
// Orders up to 16 are there, and no other; what grows along Z is so at any place.
TEST(Spectrum, HasTheWavesThatTheToolFollows) {
  for (const int sense : {1, -1}) {
    ToolSetup tool;
    tool.sense = sense;
    tool.c_start_rad = 0.7;
    std::vector<RepeatingMotion> motions;
    for (const double order : {3.0, 16.0})
      motions.push_back({example::fitted("spindle.radial_synchronous", {.order = order},
                                         {0.002 * order, -0.001})});
    const TargetSurface cylinder{
        .kind = TargetKind::cylinder, .z_start_mm = 10.0, .z_end_mm = 50.0, .radius_mm = 8.0};
    const Spectrum round(Profile(Axis{}, cylinder, tool, motions));
    EXPECT_EQ(round.orders(), (std::vector<int>{3, 16}));
    const Profile leaning(Axis{0.30, -0.1, 4e-3, 8e-3, 0.0}, cylinder, tool, motions);
    const Spectrum spectrum(leaning);
    std::vector<SlowAmplitude> found;
    for (const double z : {10.0, 23.0, 37.0, 50.0}) {
      round.at(z, found);
      for (std::size_t i = 0; i < 2; ++i) {
        const double n = round.orders()[i];
        const std::complex<double> size(0.002 * n, sense * 0.001);
        EXPECT_LT(std::abs(found[i].value - size * std::polar(1.0, sense * n * 0.7)), 1e-12);
      }
      spectrum.at(z, found);
      const auto expected = harmonics_at(leaning, z, 16);
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_LT(
            std::abs(found[i].value - expected[static_cast<std::size_t>(spectrum.orders()[i])]),
            1e-9);
    }
  }
}

// A cos(nC − φ), whatever the sense and the start of the cut. The actuator answers by Eq. 112 at n
// times the speed: here at 90 Hz, with a natural frequency of 150 Hz.
TEST(Spectrum, OfATableSaysWhatTheActuatorDoesToIt) {
  constexpr double hz = 3.0 * 30.0, of_own = hz / 150.0, hold_rad = 0.5 * two_pi * hz / 2000.0;
  Actuator actuator;
  actuator.natural_frequency_hz = 150.0, actuator.damping = 0.4;
  actuator.delay_s = 1e-4, actuator.sampling_hz = 2000.0;
  const double real = 1.0 - of_own * of_own, imaginary = 2.0 * 0.4 * of_own;
  for (const int sense : {1, -1}) {
    ToolSetup tool;
    tool.sense = sense, tool.c_start_rad = 0.7, tool.speed_rpm = 1800.0;
    std::vector<RepeatingMotion> motions;
    motions.push_back(
        {example::fitted("spindle.radial_synchronous", {.order = 3.0}, {0.006, -0.002})});
    const TargetSurface cylinder{
        .kind = TargetKind::cylinder, .z_start_mm = 10.0, .z_end_mm = 50.0, .radius_mm = 8.0};
    const auto found = table_harmonics(Profile(Axis{}, cylinder, tool, motions), actuator);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].order, 3);
    EXPECT_NEAR(found[0].amplitude_start_mm, std::hypot(0.006, 0.002), 1e-12);
    EXPECT_NEAR(found[0].amplitude_end_mm, std::hypot(0.006, 0.002), 1e-12);
    EXPECT_NEAR(found[0].phase_start_rad, std::atan2(-0.002, 0.006), 1e-9);
    EXPECT_NEAR(found[0].phase_end_rad, std::atan2(-0.002, 0.006), 1e-9);
    EXPECT_NEAR(found[0].gain, std::sin(hold_rad) / hold_rad / std::hypot(real, imaginary), 1e-12);
    EXPECT_NEAR(found[0].lag_rad, std::atan2(imaginary, real) + two_pi * hz * 1e-4 + hold_rad,
                1e-12);
  }
}

}  // namespace
}  // namespace trueaxis
