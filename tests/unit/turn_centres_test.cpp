// SPDX-License-Identifier: Apache-2.0
// Centres of turns: what scatters, steps and bends.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "measure/angles_alike.hpp"
#include "measure/centre_step.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double sigma_mm = 1e-3;

/// A helix of turns whose centre is a function of the turn; 24.3 readings each.
ProbeStream turning(std::uint64_t seed, int turns,
                    const std::function<double(double turn)>& x_mm = {},
                    const std::function<double(double theta)>& form_mm = {}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  ProbeStream out;
  for (int i = 0; i < static_cast<int>(24.3 * turns); ++i) {
    const double turn = i / 24.3, c = two_pi * turn;
    out.c_rad.push_back(c);
    out.position_mm.push_back(turn);
    out.reading_mm.push_back(20.0 + 0.05 * std::cos(c - 1.0) +
                             (x_mm ? x_mm(turn) * std::cos(c) : 0.0) +
                             (form_mm ? form_mm(c) : 0.0) + noise(random));
  }
  return out;
}

std::optional<CentreStep> step_of(const ProbeStream& stream) {
  return find_centre_step(turn_centres(stream, stream.reading_mm));
}

TEST(TurnCentres, UIsThatOfTheNoise) {
  const ProbeStream stream = turning(1, 40);
  const TurnCentres centres = turn_centres(stream, stream.reading_mm);
  // A turn is whole after 25 readings: 38 in 972.
  ASSERT_EQ(centres.list.size(), 38U);
  // σ of 38 · 21 degrees of freedom is known to 2.5 %, 4 u.
  EXPECT_NEAR(centres.sigma_mm, sigma_mm, 0.1 * sigma_mm);
  double sum2 = 0.0;
  for (const TurnCentre& one : centres.list)
    sum2 +=
        std::pow(one.x_mm - 0.05 * std::cos(1.0), 2) + std::pow(one.y_mm - 0.05 * std::sin(1.0), 2);
  // χ² of 76 degrees of freedom whose halves weigh 0.6 and 1.4 (the slope in time takes 0.61 of
  // the sine's square): 4 standard deviations.
  EXPECT_NEAR(sum2 / std::pow(centres.u_mm, 2), 76.0, 4.0 * std::sqrt(152.0 * 1.16));
}

TEST(TurnCentres, NoiseLobesBendsAndDriftsAreNoStep) {
  constexpr int streams = 2000;
  int alarms = 0;
  for (int i = 0; i < streams; ++i) alarms += step_of(turning(100 + i, 30)) ? 1 : 0;
  // At most 10⁻³ each: of 2000 more than 9 once in 20 000 times.
  EXPECT_LE(alarms, 9);
  for (int i = 0; i < 20; ++i) {
    const double size_mm = 2e-3 * (i + 1);
    EXPECT_FALSE(step_of(turning(7 + i, 30, [&](double t) { return size_mm * t / 30.0; })));
    EXPECT_FALSE(
        step_of(turning(7 + i, 30, [&](double t) { return size_mm * std::pow(t / 15.0 - 1, 2); })));
    EXPECT_FALSE(
        step_of(turning(7 + i, 30, [&](double t) { return size_mm * std::sin(1.3 * t); })));
    EXPECT_FALSE(
        step_of(turning(7 + i, 30, {}, [&](double c) { return size_mm * std::cos(3 * c); })));
  }
}

// One in 200 readings is a chip, 15 to 60 σ off.
TEST(TurnCentres, ChipsAreNoStep) {
  constexpr int streams = 2000;
  int alarms = 0;
  for (int i = 0; i < streams; ++i) {
    ProbeStream stream = turning(5000 + i, 30);
    std::mt19937_64 random(9000 + i);
    std::uniform_real_distribution<double> share(0.0, 1.0), off(15 * sigma_mm, 60 * sigma_mm);
    for (double& reading : stream.reading_mm)
      if (share(random) < 0.005) reading += (share(random) < 0.75 ? 1.0 : -1.0) * off(random);
    alarms += step_of(stream) ? 1 : 0;
  }
  // At most 10⁻³ each, as noise, and what two chips next to each other make in 730 · 0.005² of the
  // streams: of 2000 at 0.019 more than 63 once in 20 000 times.
  EXPECT_LE(alarms, 63);
}

TEST(TurnCentres, AStepIsFoundWhereItIs) {
  for (const double at : {6.0, 15.5, 24.0}) {
    const ProbeStream stream =
        turning(3, 30, [&](double turn) { return turn < at ? 0.0 : 8 * sigma_mm; });
    const auto step = step_of(stream);
    ASSERT_TRUE(step) << at;
    EXPECT_NEAR(static_cast<double>(step->reading), 24.3 * at, 1.5 * 24.3);
    // The centre of three turns on each side: u = σ √(2/24.3) √(2/3) is 0.23 σ, 4 u; a turn that
    // holds the step takes a third of it.
    EXPECT_NEAR(step->size_mm, 8 * sigma_mm, 3.6 * sigma_mm);
  }
}

/// A cone about an inclined axis, out and back in 15.3 turns each, the second pass at another angle
/// and, by `moved_mm`, elsewhere.
ProbeStream out_and_back(std::uint64_t seed, double moved_mm) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  ProbeStream out;
  for (int i = 0; i < 744; ++i) {
    const bool back = i >= 372;
    const double way = (back ? i - 372 : i) / 24.3, z = back ? 15.3 - way : way;
    const double c = two_pi * (way + (back ? 16.7 : 0.0));
    out.c_rad.push_back(c);
    out.position_mm.push_back(z);
    out.reading_mm.push_back(20.0 + 0.8 * z + (0.02 + 0.05 * z) * std::cos(c - 1.0) +
                             (back ? moved_mm * std::cos(c) : 0.0) + noise(random));
  }
  return out;
}

// A turn over the reversal does not count, and the centre runs along Z within every one: by 50 µm,
// of which a slope in time made a part a step of the centre, of the other sign on the way back.
TEST(TurnCentres, OutAndBackIsNoStepUnlessThePartMoved) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_FALSE(step_of(out_and_back(seed, 0.0))) << seed;
  EXPECT_TRUE(step_of(out_and_back(3, 200 * sigma_mm)));
}

TEST(TurnCentres, ASpreadBeyondTheirUIsBirges) {
  ProbeStream stream = turning(5, 40);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] -= 20.0 + 0.05 * std::cos(stream.c_rad[i] - 1.0);
  EXPECT_EQ(centres_spread(turn_centres(stream, stream.reading_mm), 4), 1.0);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] +=
        2 * sigma_mm * std::sin(1.3 * stream.position_mm[i]) * std::cos(stream.c_rad[i]);
  // (2 σ)²/2 over u² = 2 σ²/24.3 in one of two coordinates would make χ²/ν 1 + 12; a turn sees the
  // mean of 1.3 rad of it (sinc² 0.87), and its slope in time takes 0.61 of the sine's square, 0.3
  // of both.
  EXPECT_NEAR(centres_spread(turn_centres(stream, stream.reading_mm), 4),
              std::sqrt(1.0 + 12.0 * 0.87 * 0.7), 0.7);
}

TEST(AnglesAlike, EvenAnglesAndNearlyEvenOnes) {
  const auto at = [](double per_turn, int turns) {
    ProbeStream stream;
    for (int i = 0; i < static_cast<int>(per_turn * turns); ++i) {
      stream.c_rad.push_back(two_pi * i / per_turn);
      stream.reading_mm.push_back(0.0);
    }
    return angles_alike(stream);
  };
  EXPECT_EQ(at(4.0, 60), 4);
  EXPECT_EQ(at(4.004, 60), 4);  // 0.24 turns apart at the end: sinc(0.24) = 0.91
  EXPECT_EQ(at(12.0, 30), 12);
  EXPECT_EQ(at(36.7, 30), std::nullopt);
}

// 500 readings of a spindle that stands still before it turns are one angle, not three that repeat.
TEST(AnglesAlike, AStandstillIsOneAngle) {
  ProbeStream stream;
  for (int i = 0; i < 500; ++i) stream.c_rad.push_back(1.0);
  for (int i = 0; i <= 130; ++i) stream.c_rad.push_back(1.0 + two_pi * i / 130.3);
  stream.reading_mm.assign(stream.c_rad.size(), 0.0);
  EXPECT_EQ(angles_alike(stream), std::nullopt);
}

}  // namespace
}  // namespace trueaxis
