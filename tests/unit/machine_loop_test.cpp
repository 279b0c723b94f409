// SPDX-License-Identifier: Apache-2.0
// What is learned of the machine from part to part: weights, shrinkage, and what a verification
// contradicts. The expected values follow from Gaussian updates done one after the other.
#include "job/machine_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

/// A machine drawn from what is assumed, and parts of which each is cut off by a scatter of its
/// own.
struct DrawnMachine {
  explicit DrawnMachine(std::mt19937_64& random)
      : gain(prior.u_gain * normal(random)),
        lag(prior.u_lag_rad * normal(random)),
        scatter_mm(1e-4 * std::pow(30.0, std::uniform_real_distribution(0.0, 1.0)(random))) {}
  double normal(std::mt19937_64& random) { return std::normal_distribution(0.0, 1.0)(random); }
  LoopObservation seen(std::mt19937_64& random, const LoopResponse& used) {
    const double per_mm = 1.0 / std::uniform_real_distribution(0.02, 0.2)(random);
    const double u = std::hypot(1e-4 * per_mm, scatter_mm * per_mm);
    return {gain - used.gain + u * normal(random),
            lag - used.lag_rad + u * normal(random),
            1e-4 * per_mm,
            1e-4 * per_mm,
            per_mm,
            {}};
  }
  double gain, lag, scatter_mm;
};

// Cuts scatter by 0.1 to 3 µm, unknown to the loop. Of 3000 machines the learned lag must be within
// 2 u in 95.4 % by a normal distribution, and no less than in 94.2 % (three standard deviations).
// A machine that stays the same is refused with a probability of 0.1 %: 3 ± 1.7 of 3000.
TEST(MachineLoop, CutsThatScatterAreInTheUncertaintyAndNoChangeOfTheMachine) {
  std::printf("seed 17\n");
  std::mt19937_64 random(17);
  for (const int parts : {1, 2, 5}) {
    int covered = 0, refused = 0;
    for (int machines = 0; machines < 3000; ++machines) {
      DrawnMachine machine(random);
      MachineLoop loop;
      for (int k = 0; k < parts; ++k) {
        const LoopResponse used = response_of(loop, prior);
        loop = learned(loop, used, machine.seen(random, used));
      }
      const LoopResponse now = response_of(loop, prior);
      covered += std::abs(now.lag_rad - machine.lag) <= 2.0 * now.u_lag_rad;
      refused += trouble_with(loop, now, machine.seen(random, now), prior) != LoopTrouble::none;
    }
    EXPECT_GE(covered, 0.942 * 3000) << parts;
    EXPECT_LE(refused, 12) << parts;  // five standard deviations; gain and lag beyond any machine
  }
}

// The scatter itself: 30 parts with 1 µm tell it within four standard deviations, 1/√(2·2·30).
TEST(MachineLoop, TellsHowFarCutsScatter) {
  std::printf("seed 3\n");
  std::mt19937_64 random(3);
  DrawnMachine machine(random);
  machine.scatter_mm = 1e-3;
  MachineLoop loop;
  for (int k = 0; k < 30; ++k) loop = learned(loop, {}, machine.seen(random, {}));
  EXPECT_NEAR(response_of(loop, prior).u_cut_mm, 1e-3, 4e-3 / std::sqrt(120.0));
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
