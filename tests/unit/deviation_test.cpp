// SPDX-License-Identifier: Apache-2.0
// What straight lines or held values between the rows of a table leave of a cosine, in closed form.
#include "correct/deviation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double off_axis_mm = 1e-3;  // of a radius of 20 mm: 1e-8 mm of order 2

Correction off_axis(int rows, double c_start_rad = 0.0) {
  ToolSetup tool;
  tool.rows_per_revolution = rows;
  tool.c_start_rad = c_start_rad;
  const TargetSurface cylinder{TargetKind::cylinder, false, 0.0, 2.0, 20.0, 0.0, 0.0, 0.0, 0.0};
  return make_correction({{off_axis_mm, 0.0, 0.0, 0.0, 0.0}, {}}, cylinder, tool, {});
}

// Order 1 of a value held over M rows is sinc(π/M) e^(−iπ/M) of itself. Before the first row there
// is no other value, so the first revolution does not step there: Simpson's weight of one reading.
// Tolerance: Simpson's h⁴/180 with 64 steps or more, 5e-7 of the amplitude, and order 2.
TEST(Deviation, OfHeldValuesIsThatOfTheHold) {
  constexpr double tolerance_mm = 1e-6 * off_axis_mm + 2e-8;
  for (const int rows : {8, 13}) {
    const double half = std::numbers::pi / rows;
    for (int k = 0; k < 8; ++k) {
      const double start = 0.3 + k * two_pi / 8.0;
      const std::complex<double> wave = std::polar(off_axis_mm, start);
      const std::complex<double> later = wave * (std::polar(std::sin(half) / half, -half) - 1.0);
      const auto per_rev = static_cast<std::size_t>(rows);
      const double weight = 4.0 / 3.0 / static_cast<double>(per_rev * parts_between(per_rev));
      const double step = off_axis_mm * (std::cos(start - 2.0 * half) - std::cos(start));
      const Deviation off = off_axis(rows, start).held_rows;
      EXPECT_NEAR(off.once_mm, std::max(std::abs(later), std::abs(later - 0.5 * weight * step)),
                  tolerance_mm)
          << rows << ' ' << start;
    }
    // One of the steps is within half a row of the steepest place.
    const double steepest = 2.0 * off_axis_mm * std::sin(half);
    const double largest_mm = off_axis(rows).held_rows.largest_mm;
    EXPECT_LE(largest_mm, steepest + tolerance_mm);
    EXPECT_GE(largest_mm, steepest * std::cos(half) - tolerance_mm);
  }
}

// An eccentricity that falls to nothing along the cut is most in the first revolution. There the
// chord over a row is (π/M)²/2 of it; half a revolution on it has fallen by 2.5 %.
TEST(Deviation, LooksAtTheFirstRevolution) {
  constexpr int rows = 36;
  ToolSetup tool;
  tool.rows_per_revolution = rows;
  const TargetSurface cut{TargetKind::cylinder, false, 0.0, 2.0, 20.0, 0.0, 0.0, 0.0, 0.0};
  const Correction falls =
      make_correction({{off_axis_mm, 0.0, -0.5 * off_axis_mm, 0.0, 0.0}, {}}, cut, tool, {});
  const double half = std::numbers::pi / rows, chord_mm = 0.5 * half * half * off_axis_mm;
  EXPECT_NEAR(falls.between_rows.largest_mm, chord_mm, 0.01 * chord_mm);
}

// The deviation falls with the rows, that of straight lines with their square: by 0.3 % and more
// for one row of 360.
TEST(Deviation, OneRowMoreIsAskedForWhereThatDoes) {
  constexpr int rows = 360;
  const Correction now = off_axis(rows);
  const Profile profile(now.commanded_axis(), now.target, now.tool);
  for (const Interpolation by : {Interpolation::linear, Interpolation::none}) {
    const auto within = [&](int tried) {
      Deviation limit = between_rows(profile, tried, by);
      limit.largest_mm *= 1.001, limit.once_mm *= 1.001;
      return limit;
    };
    EXPECT_EQ(rows_that_would_do(now, by, within(rows)), rows);
    EXPECT_EQ(rows_that_would_do(now, by, within(rows + 1)), rows + 1);
    EXPECT_EQ(rows_that_would_do(now, by, {1e-15, 1e-15}), 0);
  }
}

}  // namespace
}  // namespace trueaxis
