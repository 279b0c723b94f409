// SPDX-License-Identifier: Apache-2.0
// The angles of sensors that motion shows which does not repeat: their u counts the freedom that
// what repeats has taken of the readings. Short recordings with right angles were refused.
#include "spindle/seen_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

TEST(SpindleSeenAngles, UOfTwoTurnsCountsThatTheirMeanIsSubtracted) {
  const std::vector<double> angles{0.0, 55 * rad_per_deg, 113.2 * rad_per_deg};
  constexpr Eigen::Index per_turn = 128;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> phase(0.0, two_pi);
  double squares = 0.0;
  int count = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double p = phase(engine), q = phase(engine);
    Eigen::MatrixXd read(2 * per_turn, 3);
    for (Eigen::Index i = 0; i < read.rows(); ++i) {
      const double C = two_pi * static_cast<double>(i) / per_turn;
      const double x = std::cos(0.42 * C - p), y = std::cos(1.37 * C - q);
      for (Eigen::Index s = 0; s < 3; ++s) {
        const double at = angles[static_cast<std::size_t>(s)];
        read(i, s) = x * std::cos(at) + y * std::sin(at) + 0.02 * normal(engine);
      }
    }
    const Eigen::MatrixXd mean = 0.5 * (read.topRows(per_turn) + read.bottomRows(per_turn));
    read.topRows(per_turn) -= mean;
    read.bottomRows(per_turn) -= mean;
    const auto seen = seen_angles(angles, read, 0.5, 10.0 * rad_per_deg);
    for (std::size_t s = 1; s < seen.size(); ++s) {
      const double off = (seen[s].from_first_rad - angles[s]) / seen[s].u_rad;
      squares += off * off;
      ++count;
    }
  }
  ASSERT_GT(count, 400);
  // χ² of 400, both angles of a trial as one: 3.3 standard deviations are 23 % of the variance.
  std::cout << "seed 7: variance over u² " << squares / count << " of " << count << '\n';
  EXPECT_NEAR(squares / count, 1.0, 0.25);
}

}  // namespace
}  // namespace trueaxis
