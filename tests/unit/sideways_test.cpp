// SPDX-License-Identifier: Apache-2.0
#include "measure/sideways.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double sigma_mm = 1e-3;

/// Readings of an undercut of 0.2 mm with a taper, `dx_mm` off along x.
Sideways of_undercut(double turns, double dx_mm, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  std::vector<double> c_rad, z_mm, off_mm;
  for (double turn = 0.0; turn < turns; turn += 1.0 / 37.3) {
    c_rad.push_back(two_pi * turn), z_mm.push_back(38.0 + turn);
    off_mm.push_back(-0.2 + 0.01 * turn + dx_mm * std::cos(two_pi * turn) + noise(random));
  }
  return sideways_of(c_rad, z_mm, off_mm);
}

// Of the squares of x and y by their u the mean is 2 if both are 0: with s from the readings
// themselves a little more (F law), 200 streams of it hold 2 ± 4 · 2 / √200.
TEST(Sideways, AnotherDiameterStaysWhereItIs) {
  constexpr int streams = 200;
  double sum = 0.0;
  for (unsigned seed = 0; seed < streams; ++seed) {
    const Sideways one = of_undercut(2.0, 0.0, seed);
    sum += one.size_mm * one.size_mm / (one.u_mm * one.u_mm);
    EXPECT_TRUE(one.stays(0.0, 1e-3) || one.size_mm > 3.0 * one.u_mm) << seed;
  }
  EXPECT_LT(sum / streams, 2.0 + 4.0 * 2.0 / std::sqrt(streams));
  EXPECT_GT(sum / streams, 1.0);  // u is the larger of two
}

TEST(Sideways, AMovementIsSeen) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Sideways moved = of_undercut(2.0, 0.003, seed);
    EXPECT_NEAR(moved.size_mm, 0.003, 5.0 * moved.u_mm) << seed;  // x and y
    EXPECT_FALSE(moved.stays(0.0, 1e-3)) << seed;
  }
}

// A third of a turn does not tell a shift from a taper: u says so.
TEST(Sideways, AnArcShowsNothing) {
  for (unsigned seed = 0; seed < 20; ++seed)
    EXPECT_FALSE(of_undercut(1.0 / 3.0, 0.0, seed).stays(0.0, 1e-3)) << seed;
  EXPECT_TRUE(std::isinf(sideways_of({}, {}, {}).u_mm));
}

}  // namespace
}  // namespace trueaxis
