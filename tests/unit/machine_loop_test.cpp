// SPDX-License-Identifier: Apache-2.0
// What is learned of the machine from part to part: weights, shrinkage, and what a verification
// contradicts. The expected values follow from Gaussian updates done one after the other.
#include "job/machine_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trueaxis {
namespace {

constexpr LoopPrior prior{0.06, 0.5};

MachineLoop after(std::initializer_list<LoopObservation> parts) {
  MachineLoop loop;
  for (const LoopObservation& seen : parts) loop = learned(loop, {}, seen);
  return loop;
}

TEST(MachineLoop, OnePartIsShrunkByThePriorsShare) {
  const LoopResponse one = response_of(after({{0.02, 0.1, 0.03, 0.5}}), prior);
  EXPECT_NEAR(one.gain, 0.02 * 0.06 * 0.06 / (0.06 * 0.06 + 0.03 * 0.03), 1e-15);
  EXPECT_NEAR(one.lag_rad, 0.05, 1e-15);
  EXPECT_NEAR(one.u_lag_rad, 0.5 / std::sqrt(2.0), 1e-15);
}

// A Kalman filter without process noise, step by step. The parts agree, so nothing is widened.
TEST(MachineLoop, IsTheKalmanFilterOfPartsThatAgree) {
  double value = 0.0, variance = prior.u_lag_rad * prior.u_lag_rad, gain_before = 1.0;
  MachineLoop loop;
  for (const double seen : {0.101, 0.099, 0.1, 0.1005}) {
    const LoopResponse used = response_of(loop, prior);
    loop = learned(loop, used, {0.0, seen - used.lag_rad, 0.01, 0.02});
    const double gain = variance / (variance + 0.02 * 0.02);
    EXPECT_LT(gain, gain_before) << "each part counts less than the one before";
    value += gain * (seen - value), variance *= 1.0 - gain, gain_before = gain;
    const LoopResponse now = response_of(loop, prior);
    EXPECT_NEAR(now.lag_rad, value, 1e-14);
    EXPECT_NEAR(now.u_lag_rad, std::sqrt(variance), 1e-14);
  }
}

// Two parts 8 u apart in the lag: χ² = 8²/2 over 2 degrees of freedom widens variances by 16.
TEST(MachineLoop, PartsThatScatterMoreThanTheirUWidenIt) {
  const LoopResponse two =
      response_of(after({{0.0, -0.04, 0.01, 0.01}, {0.0, 0.04, 0.01, 0.01}}), {1e6, 1e6});
  EXPECT_NEAR(two.u_lag_rad, 4.0 * 0.01 / std::sqrt(2.0), 1e-9);
}

TEST(MachineLoop, NamesWhatAVerificationContradicts) {
  const MachineLoop before = after({{0.01, 0.1, 1e-3, 1e-3}});
  const LoopResponse used = response_of(before, prior);
  const auto trouble = [&](double gain, double lag) {
    return trouble_with(before, used, {gain, lag, 1e-3, 1e-3}, prior);
  };
  EXPECT_EQ(trouble(0.0, 0.0), LoopTrouble::none);
  EXPECT_EQ(trouble(0.003, -0.003), LoopTrouble::none);  // 2 u each
  EXPECT_EQ(trouble(0.02, 0.2), LoopTrouble::wrong_sign);
  EXPECT_EQ(trouble(0.0, 0.02), LoopTrouble::changed);
  EXPECT_EQ(trouble(0.0, -0.1), LoopTrouble::changed);  // as if nothing were wrong any more
  EXPECT_EQ(trouble(0.0, 3.0), LoopTrouble::beyond_machines);
  EXPECT_EQ(trouble(-0.5, 0.0), LoopTrouble::beyond_machines);
  // Without a correction no sign can be wrong.
  EXPECT_EQ(trouble_with({}, {}, {0.0, 0.2, 1e-3, 1e-3}, prior), LoopTrouble::none);
}

// The axis moves by gain along its eccentricity and by lag across it.
TEST(MachineLoop, UncertaintyIsAlongAndAcrossTheEccentricity) {
  const AxisCovariance c = covariance_of({0.0, 0.0, 0.01, 0.1}, {3.0, 4.0, 0.0, 0.0, 0.0});
  using enum AxisRow;
  const double along = (9 * c(x, x) + 24 * c(x, y) + 16 * c(y, y)) / 25.0,
               across = (16 * c(x, x) - 24 * c(x, y) + 9 * c(y, y)) / 25.0;
  EXPECT_NEAR(std::sqrt(along), 0.05, 1e-15);
  EXPECT_NEAR(std::sqrt(across), 0.5, 1e-15);
}

}  // namespace
}  // namespace trueaxis
