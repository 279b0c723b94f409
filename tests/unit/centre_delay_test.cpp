// SPDX-License-Identifier: Apache-2.0
// A delay of X turns the centres with the speed of the spindle; a slip moves them anywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "measure/centre_step.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double e_mm = 0.08, sigma_of_late_mm = 1e-3, per_turn_of_late = 24.3;
constexpr int turns_of_late = 50;  // 25 at each speed

struct LatePart {
  double delay_s = 0.0, first_rpm = 60.0, second_rpm = 150.0;
  double slip_x_mm = 0.0, slip_y_mm = 0.0, slip_turn = 25.0;
};

/// Out and back along a shaft that is tilted by 0.2 mrad, half a second apart.
ProbeStream late_stream(const LatePart& part, std::uint64_t seed, bool timed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_of_late_mm);
  ProbeStream out;
  double t = 0.0;
  const auto half = static_cast<int>(per_turn_of_late * turns_of_late / 2);
  for (int i = 0; i < 2 * half; ++i) {
    const double turn = i / per_turn_of_late;
    const double speed = two_pi / 60.0 * (i < half ? part.first_rpm : part.second_rpm);
    const double c = two_pi * turn, met = c - speed * part.delay_s;
    const double z = i < half ? turn : 2.0 * half / per_turn_of_late - turn;
    const bool slipped = turn >= part.slip_turn;
    const double x = e_mm * std::cos(0.7) + 2e-4 * z + (slipped ? part.slip_x_mm : 0.0);
    const double y = e_mm * std::sin(0.7) + (slipped ? part.slip_y_mm : 0.0);
    t += two_pi / per_turn_of_late / speed + (i == half ? 0.5 : 0.0);
    out.c_rad.push_back(c);
    out.position_mm.push_back(z);
    if (timed) out.time_s.push_back(t);
    out.reading_mm.push_back(30.0 + x * std::cos(met) + y * std::sin(met) + noise(random));
  }
  return out;
}

std::optional<CentreStep> weighed(const LatePart& part, std::uint64_t seed, bool timed = true) {
  const ProbeStream stream = late_stream(part, seed, timed);
  const auto step = find_centre_step(turn_centres(stream, stream.reading_mm));
  if (!step) return {};
  return weighed_with_delay(*step, stream, stream.reading_mm);
}

// Noise makes a slip of a delay once in 1000 streams: of 200 more than 3 once in 17 000 times.
TEST(CentreDelay, ADelayIsNotCalledASlip) {
  for (const bool timed : {true, false}) {
    int slips = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const double delay_s = (seed % 2 == 0 ? 1.0 : -1.0) * 5e-3;
      const auto step = weighed({.delay_s = delay_s}, seed, timed);
      ASSERT_TRUE(step) << "seed " << seed;
      slips += step->may_be_delay ? 0 : 1;
      if (!step->may_be_delay) continue;
      EXPECT_TRUE(moved_text(*step).find("or the part slipped") != std::string::npos);
      EXPECT_EQ(std::isnan(step->delay_s), !timed);
      // A centre has u = σ √(2/24.3), up to 1.6 times across because of its drift. The line in time
      // takes 3/4 of a step's square: 4 u/√48 is 0.22 µm, at 80 µm and 9.4 rad/s 0.29 ms. 5 u.
      if (timed) {
        EXPECT_NEAR(step->delay_s, delay_s, 1.5e-3) << "seed " << seed;
      }
    }
    EXPECT_LE(slips, 3) << (timed ? "with times" : "without");
  }
}

// Towards the axis a slip of 12 σ is 37 u of the mean of 25 centres, and no delay does that.
TEST(CentreDelay, ASlipStaysOne) {
  const double x = -0.012 * std::cos(0.7), y = -0.012 * std::sin(0.7);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const double turn : {12.0, 25.0, 38.0})
      for (const bool timed : {true, false}) {
        const auto step = weighed({.slip_x_mm = x, .slip_y_mm = y, .slip_turn = turn}, seed, timed);
        ASSERT_TRUE(step) << "seed " << seed << " at " << turn;
        EXPECT_FALSE(step->may_be_delay) << "seed " << seed << " at " << turn;
        EXPECT_TRUE(moved_text(*step).find("the part slipped there, C lost") != std::string::npos);
      }
    // At one speed a delay moves nothing, whatever way the part goes.
    const auto across = weighed({.second_rpm = 60.0, .slip_x_mm = y, .slip_y_mm = -x}, seed);
    ASSERT_TRUE(across);
    EXPECT_FALSE(across->may_be_delay) << "seed " << seed;
    // A reading after the change of speed and across, nothing tells the two apart.
    const auto either = weighed({.slip_x_mm = y, .slip_y_mm = -x}, seed);
    ASSERT_TRUE(either);
    EXPECT_TRUE(either->may_be_delay) << "seed " << seed;
  }
}

// A delay does not hide a slip elsewhere.
TEST(CentreDelay, ADelayAndASlipAreASlip) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto step =
        weighed({.delay_s = 5e-3, .slip_x_mm = -0.02, .slip_y_mm = -0.02, .slip_turn = 12.0}, seed);
    ASSERT_TRUE(step) << "seed " << seed;
    EXPECT_FALSE(step->may_be_delay) << "seed " << seed;
  }
}

}  // namespace
}  // namespace trueaxis
