// SPDX-License-Identifier: Apache-2.0
// Each mend of a column undoes the misreading that it is for, and leaves an ordinary stream alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/mend_columns.hpp"
#include "fit/plausible.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// An eccentric part with lobes along 20 revolutions, 37 readings each, from 0.4 rad on.
ProbeStream run_out(double sense = 1.0, double readings = 37.0) {
  ProbeStream stream;
  for (int i = 0; i <= 20 * 37; ++i) {
    const double c = 0.4 + sense * two_pi * i / readings;
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

// Depth and run-out of a keyway come near the range of a display, but X does not go on at its edges
// as elsewhere: 0.1 mm are left of 0.4, and elsewhere it goes 0.05 mm · 2π/36 from one to the next.
TEST(MisreadColumns, AKeywayIsNoEndOfADial) {
  ProbeStream keyway = run_out();
  for (double& x : keyway.reading_mm) x = 20.0 + 0.05 / 0.09 * 0.7 * (x - 20.0);
  for (std::size_t i = 0; i < keyway.size(); ++i)
    if (std::abs(std::remainder(keyway.c_rad[i] - 1.0, two_pi)) < 0.3) keyway.reading_mm[i] -= 0.4;
  const ProbeStream as_written = keyway;
  unwrap_reading(keyway);
  EXPECT_EQ(keyway.reading_mm, as_written.reading_mm);
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
    ProbeStream small = stream;  // a thousandth of the eccentricity and of the drift
    for (double& x : small.reading_mm) x *= 1e-3;
    for (ProbeStream* one : {&stream, &small}) {
      turn_as_reading_does(*one);
      EXPECT_NEAR(one->c_rad.back() / right.c_rad.back(), 1.0, 5e-4) << factor;
    }
  }
}

// What goes once per revolution with a ninth of the square or more is an eccentricity, and no other
// wave is then the revolution.
TEST(MisreadColumns, AnEccentricityIsNoOtherWave) {
  for (const double share : {0.095, 0.125}) {
    ProbeStream stream = run_out();
    for (std::size_t i = 0; i < stream.size(); ++i) {
      const double c = stream.c_rad[i];
      stream.reading_mm[i] = 20.0 + 0.02 * (std::sqrt(share) * std::cos(c) +
                                            std::sqrt(1.0 - share) * std::cos(1.371 * c));
    }
    turn_as_reading_does(stream);
    const double turned = stream.c_rad.back() / run_out().c_rad.back();
    EXPECT_NEAR(turned, share < 1.0 / 9.0 ? 1.371 : 1.0, 2e-3) << share;
  }
}

// A step of the search, a quarter of a turn over the stream, is what it tells from once per
// revolution.
TEST(MisreadColumns, ALineNextToOncePerRevolutionIsThat) {
  constexpr double step = 0.25 / 20.0;
  for (const double steps : {-1.4, -0.6, 0.6, 1.4}) {
    const ProbeStream right = run_out();
    ProbeStream stream = right;
    for (double& c : stream.c_rad) c /= 1.0 + steps * step;
    const std::vector<double> before = stream.c_rad;
    turn_as_reading_does(stream);
    if (std::abs(steps) < 1.0)
      EXPECT_EQ(stream.c_rad, before) << steps;
    else
      EXPECT_NEAR(stream.c_rad.back() / right.c_rad.back(), 1.0, 5e-4) << steps;
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

bool alike(const std::vector<double>& found, const std::vector<double>& expected) {
  for (std::size_t i = 0; i < found.size(); ++i)
    if (std::abs((found[i] - found[0]) - (expected[i] - expected[0])) > 1e-7) return false;
  return true;
}

/// What a stream is misread as, where only `right` is a part's: of it a fit leaves `again_mm` in
/// place of 90 µm.
std::string misread_as(const ProbeStream& stream, const ProbeStream& right, double again_mm = 1e-4,
                       std::size_t points = 741) {
  FitResult found;
  found.surface = SurfaceKind::cylinder;
  found.residual_mm.assign(stream.size(), 0.09), found.rms_mm = 0.09;
  return likely_misreading(stream, found, [&](const ProbeStream& tried, SurfaceKind) {
    FitResult again;
    again.status = FitStatus::converged, again.points = points, again.parameters.resize(5);
    const bool same = alike(tried.c_rad, right.c_rad) &&
                      alike(tried.reading_mm, right.reading_mm) &&
                      alike(tried.position_mm, right.position_mm);
    again.rms_mm = same ? again_mm : 0.08;
    return again;
  });
}

/// The angle of every row changed.
template <class Change>
ProbeStream with_c(ProbeStream stream, Change change) {
  for (double& c : stream.c_rad) c = change(c);
  return stream;
}

// Every unit under the header of every other, and angles that restart or count otherwise. 17
// readings per revolution are 3 if radians are read as revolutions: a spindle has more.
TEST(FitMisreading, EachWayToReadAStreamIsFound) {
  const ProbeStream right = run_out(1.0, 17.0);
  const struct {
    double factor;
    const char* what;
  } units[] = {{rad_per_deg, "C is in radians"},       {two_pi, "C is in radians"},
               {1.0 / rad_per_deg, "C is in degrees"}, {360.0, "C is in degrees"},
               {1.0 / 360.0, "C is in turns"},         {1.0 / two_pi, "C is in turns"},
               {1.0 / 0.9, "C has 400 gon"},           {2.0, "C runs at twice the angle"},
               {0.5, "C runs at half the angle (or"}};
  for (const auto& [factor, what] : units) {
    const std::string found =
        misread_as(with_c(right, [&](double c) { return factor * c; }), right);
    EXPECT_TRUE(found.starts_with(what)) << factor << ' ' << found;
  }
  // At 36.7 readings per revolution they are 5.8, as of a spindle: the residuals tell.
  const ProbeStream dense = run_out(1.0, 36.7);
  const std::string found = misread_as(with_c(dense, [](double c) { return two_pi * c; }), dense);
  EXPECT_TRUE(found.starts_with("C is in radians")) << found;
  const auto restarts = [](double turn) {
    return [turn](double c) { return c - turn * std::floor(c / turn); };
  };
  for (const auto& [turn, what] :
       {std::pair{0.5, "C restarts every 180°"}, {0.25, "C restarts every 90°"}}) {
    const std::string found = misread_as(with_c(right, restarts(turn * two_pi)), right);
    EXPECT_TRUE(found.starts_with(what)) << turn << ' ' << found;
  }
  const std::string half =
      misread_as(with_c(right, [&](double c) { return restarts(0.5 * two_pi)(0.5 * c); }), right);
  EXPECT_TRUE(half.starts_with("C restarts after a revolution that does not have 360°")) << half;
}

// A third of the residuals as written; enough readings for two fits.
TEST(FitMisreading, AnotherWayIsTakenIfItIsFarBetter) {
  const ProbeStream right = run_out();
  const ProbeStream gon = with_c(right, [](double c) { return c / 0.9; });
  EXPECT_NE(misread_as(gon, right, 0.0295), "");
  EXPECT_EQ(misread_as(gon, right, 0.0305), "");
  EXPECT_NE(misread_as(gon, right, 1e-4, 20), "");
  EXPECT_EQ(misread_as(gon, right, 1e-4, 19), "");
  const ProbeStream half = with_c(right, [](double c) { return 0.5 * c; });
  EXPECT_NE(misread_as(half, right, 0.0295), "");
  EXPECT_EQ(misread_as(half, right, 0.0305), "");
  // In the words of the numbers as written and otherwise.
  EXPECT_NE(
      misread_as(gon, right, 1e-4)
          .find("As written the residuals are 90 µm RMS (C from 25.46° to 8025°, 22.2 revolutions, "
                "0.601 per mm), otherwise 0.1 µm (C from 22.92° to 7223°, 20 revolutions, 0.541 "
                "per mm)"),
      std::string::npos)
      << misread_as(gon, right, 1e-4);
}

// Nine tenths of a revolution are a turn; steps of a quarter are of one.
TEST(FitMisreading, WhatIsReadOtherwiseGoesRound) {
  for (const double turns : {0.88, 0.92}) {
    ProbeStream right = run_out();
    for (double& c : right.c_rad) c *= turns / 20.0;
    const ProbeStream radians = with_c(right, [](double c) { return rad_per_deg * c; });
    EXPECT_EQ(misread_as(radians, right) != "", turns > 0.9) << turns;
  }
  for (const double step : {0.24, 0.26}) {
    ProbeStream right = run_out();
    for (double& c : right.c_rad) c *= 37.0 * step;
    const ProbeStream degrees = with_c(right, [](double c) { return c / rad_per_deg; });
    EXPECT_EQ(misread_as(degrees, right) != "", step < 0.25) << step;
  }
}

// If there is no surface at all, all of the readings are residuals.
TEST(FitMisreading, WithoutASurfaceTheReadingsAreLeft) {
  ProbeStream stream;
  stream.reading_mm = {3.0, 5.0, 10.0};
  EXPECT_NEAR(left_mm(stream, {}), std::sqrt((9.0 + 1.0 + 16.0) / 3.0), 1e-15);
  FitResult fit;
  fit.residual_mm = {0.1, -0.1, 0.1}, fit.rms_mm = 0.1;
  EXPECT_EQ(left_mm(stream, fit), 0.1);
}

TEST(FitMisreading, ColumnsAreExchanged) {
  const ProbeStream right = run_out();
  ProbeStream stream = right;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    stream.c_rad[i] = right.position_mm[i] * rad_per_deg * 0.1;  // a tenth of 37 mm as degrees
    stream.position_mm[i] = right.c_rad[i] / rad_per_deg;
  }
  ProbeStream shorter = right;
  for (double& z : shorter.position_mm) z *= 0.1;
  EXPECT_TRUE(misread_as(stream, shorter).starts_with("C and Z are exchanged"));
  stream = right;
  std::swap(stream.reading_mm, stream.position_mm);
  EXPECT_TRUE(misread_as(stream, right).starts_with("X_M and Z are exchanged"));
}

}  // namespace
}  // namespace trueaxis
