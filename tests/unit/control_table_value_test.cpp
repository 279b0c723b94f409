// SPDX-License-Identifier: Apache-2.0
// What a control reads between the rows of a table whose values have no law.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "correct/control/control_table.hpp"
#include "trueaxis/control_table.hpp"
#include "trueaxis/correction.hpp"

namespace trueaxis {
namespace {

constexpr int per_rev = 24, revolutions = 15;

/// The path in rows of `feed_mm` a revolution, as a file has it; the last revolution does not feed.
struct Table {
  CorrectionRows rows;
  std::vector<double> values;

  explicit Table(double feed_mm) {
    std::mt19937_64 random(31);
    std::normal_distribution<double> normal;
    for (int i = 0; i < per_rev * revolutions; ++i) {
      const double turns = std::min(static_cast<double>(i) / per_rev, revolutions - 1.0);
      rows.position_mm.push_back(std::round(1e4 * (40.0 + feed_mm * turns)) * 1e-4);
      values.push_back(normal(random));
    }
  }
  double at(double turns, double position_mm) const {
    return table_value_mm(rows, values, per_rev, turns, position_mm);
  }
};

// A row's own value at its place, in both directions. Positions are rounded to 0.1 µm, which puts
// some of them into the revolution before; the value there is that of the row to the rounding of a
// share of 1.
TEST(ControlTableValue, IsTheRowsOwnAtItsPlace) {
  for (const double feed_mm : {0.1237, -0.1237, 2.7183, -2.7183}) {
    const Table table(feed_mm);
    for (std::size_t i = 0; i < per_rev * (revolutions - 1); ++i)
      EXPECT_NEAR(table.at(static_cast<double>(i) / per_rev, table.rows.position_mm[i]),
                  table.values[i], 1e-9)
          << feed_mm << ' ' << i;
  }
}

// Half way to the next row, and half way to the next revolution there: linear in both.
TEST(ControlTableValue, IsTheMeanOfItsFourNeighboursInTheMiddle) {
  for (const double feed_mm : {0.12, -0.12, 2.4, -2.4}) {
    const Table table(feed_mm);
    for (std::size_t i = 0; i + per_rev + 1 < per_rev * (revolutions - 1); ++i) {
      const std::vector<double>&z = table.rows.position_mm, &v = table.values;
      const auto mean = [&](const std::vector<double>& of) {
        return 0.25 * (of[i] + of[i + 1] + of[i + per_rev] + of[i + per_rev + 1]);
      };
      EXPECT_NEAR(table.at((static_cast<double>(i) + 0.5) / per_rev, mean(z)), mean(v), 1e-9);
    }
  }
}

// Just after a row and just before that of the next revolution: 4 in 10000 of a feed of 0.1237 mm
// is less than what its rounding to 0.1 µm makes of the place of a row after some revolutions.
TEST(ControlTableValue, IsLinearCloseToARowAsWell) {
  for (const double feed_mm : {0.12374, -0.12374, 0.02006}) {
    const Table table(feed_mm);
    const std::vector<double>&z = table.rows.position_mm, &v = table.values;
    for (std::size_t i = 0; i + per_rev < per_rev * (revolutions - 1); ++i)
      for (const double share : {4e-4, 1.0 - 4e-4})
        EXPECT_NEAR(
            table.at(static_cast<double>(i) / per_rev, z[i] + share * (z[i + per_rev] - z[i])),
            v[i] + share * (v[i + per_rev] - v[i]), 1e-9)
            << feed_mm << ' ' << i << ' ' << share;
  }
}

TEST(ControlTableValue, BeyondThePathItsEndsAreHeld) {
  for (const double feed_mm : {0.12, -0.12}) {
    const Table table(feed_mm);
    EXPECT_EQ(table.at(0.0, 40.0 - 9.0 * feed_mm), table.values.front());
    const double end = 40.0 + (revolutions - 1) * feed_mm;
    EXPECT_EQ(table.at(0.25, end + feed_mm), table.at(0.25, end));
  }
}

// A turn on, and a turn back, is the same place of a table that a control reads by its angle.
TEST(CorrectionGrid, HasThePeriodOfATurn) {
  CorrectionGrid grid;
  grid.position_mm = {0.0, 2.0}, grid.angles = 5;
  grid.value_mm = {0.0, 1.0, 4.0, 9.0, 0.0, 10.0, 11.0, 14.0, 19.0, 10.0};
  constexpr double quarter = 1.5707963267948966;
  for (const double turns : {-8.0, -4.0, 0.0, 4.0, 400.0}) {
    EXPECT_NEAR(grid.between((1.25 + turns) * quarter, 0.0), 1.75, 1e-9) << turns;
    EXPECT_NEAR(grid.between((3.5 + turns) * quarter, 1.0), 9.5, 1e-9) << turns;
  }
  EXPECT_EQ(grid.between(quarter, 7.0), 11.0) << "its end is held";
}

}  // namespace
}  // namespace trueaxis
