// SPDX-License-Identifier: Apache-2.0
// Each mend of a column undoes the misreading that it is for, and leaves an ordinary stream alone.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/mend_columns.hpp"

namespace trueaxis {
namespace {

/// An eccentric part with lobes along 20 revolutions, 37 readings each, from 0.4 rad on.
ProbeStream run_out(double sense = 1.0) {
  ProbeStream stream;
  for (int i = 0; i <= 20 * 37; ++i) {
    const double c = 0.4 + sense * two_pi * i / 37.0;
    stream.c_rad.push_back(c);
    stream.reading_mm.push_back(20.0 + 0.2 * std::cos(c - 1.0) + 0.002 * std::cos(3.0 * c));
    stream.position_mm.push_back(0.05 * i);
  }
  return stream;
}

/// To the rounding of sums of their size.
void expect_alike(const std::vector<double>& found, const std::vector<double>& expected,
                  double constant = 0.0) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_NEAR(found[i], expected[i] + constant, 1e-9) << i;
}

// 400 gon, 6400 mils and a counter of 1024 that restart once per revolution, in either sense.
TEST(MisreadColumns, AnAngleThatRestartsEachTurnIsMadeContinuous) {
  for (const double sense : {1.0, -1.0})
    for (const double turn : {400.0, 6400.0, 1024.0}) {
      const ProbeStream right = run_out(sense);
      ProbeStream stream = right;
      for (double& c : stream.c_rad) c = turn * (c / two_pi - std::floor(c / two_pi));
      begin_anew_each_turn(stream);
      expect_alike(stream.c_rad, right.c_rad);
    }
}

TEST(MisreadColumns, AnAngleThatGoesOnIsLeft) {
  for (const double sense : {1.0, -1.0}) {
    ProbeStream stream = run_out(sense);
    begin_anew_each_turn(stream);
    EXPECT_EQ(stream.c_rad, run_out(sense).c_rad);
  }
}

// With readings at the folds: next to one that lies between, nothing tells its side.
TEST(MisreadColumns, AnAngleThatWasFoldedRunsOn) {
  ProbeStream right;
  for (int i = 0; i < 200; ++i) right.c_rad.push_back(two_pi * i / 36.0);
  ProbeStream stream = right;
  for (double& c : stream.c_rad) c = std::abs(std::remainder(c, two_pi));
  unfold_c(stream);
  expect_alike(stream.c_rad, right.c_rad);
}

// A dial of 0.5 mm that the readings of a bow of 1.2 mm pass twice.
TEST(MisreadColumns, AReadingThatRestartsAtTheEndOfItsDialIsMadeContinuous) {
  for (const double dial_mm : {0.5, 1.0, 2.0}) {
    ProbeStream right = run_out();
    for (double& x : right.reading_mm) x = 20.0 + 4.0 * dial_mm * (x - 20.0);
    for (std::size_t i = 0; i < right.size(); ++i)
      right.reading_mm[i] += dial_mm * static_cast<double>(i) / static_cast<double>(right.size());
    ProbeStream stream = right;
    for (double& x : stream.reading_mm) x -= dial_mm * std::floor(x / dial_mm);
    unwrap_reading(stream);
    expect_alike(stream.reading_mm, right.reading_mm, stream.reading_mm[0] - right.reading_mm[0]);
  }
}

// The largest wave then turns once per revolution. Over 20 revolutions the periodogram of one wave
// has its peak at its order, to within the wave of the opposite sense: 1/(4π · 20)² of an order
// or, with a line subtracted, a few times that. A step of the search is 0.25/20 of an order. The
// readings drift by twelve times the wave.
TEST(MisreadColumns, TheReadingTurnsOncePerRevolution) {
  for (const double factor : {0.4123, 0.7357, 1.3171, 1.6771}) {
    const ProbeStream right = run_out();
    ProbeStream stream = right;
    for (std::size_t i = 0; i < stream.size(); ++i) stream.reading_mm[i] += 0.02 * right.c_rad[i];
    for (double& c : stream.c_rad) c *= factor;
    turn_as_reading_does(stream);
    EXPECT_NEAR(stream.c_rad.back() / right.c_rad.back(), 1.0, 5e-4) << factor;
  }
}

// An ordinary stream and one whose largest wave is lobes.
TEST(MisreadColumns, LobesAreNotTurns) {
  ProbeStream stream = run_out();
  turn_as_reading_does(stream);
  EXPECT_EQ(stream.c_rad, run_out().c_rad);
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.reading_mm[i] = 20.0 + 0.2 * std::cos(3.0 * stream.c_rad[i]);
  turn_as_reading_does(stream);
  EXPECT_EQ(stream.c_rad, run_out().c_rad);
}

// As above, of half the revolutions: four times the tolerance. A walk over those of the gap would
// take hours.
TEST(MisreadColumns, AGapOfManyTurnsIsNotLookedThrough) {
  ProbeStream right = run_out();
  for (std::size_t i = 400; i < right.size(); ++i) right.c_rad[i] += 1e7 * two_pi;
  ProbeStream stream = right;
  for (double& c : stream.c_rad) c *= 1.3171;
  turn_as_reading_does(stream);
  EXPECT_NEAR(stream.c_rad[399] / right.c_rad[399], 1.0, 2e-3);
}

}  // namespace
}  // namespace trueaxis
