// SPDX-License-Identifier: Apache-2.0
// Columns whose rows are not those of the others, and rows in any order, which are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

#include "measure/column_checks.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr int readings = 900;

/// A helix of 25 turns on a part 60 µm off the axis.
ProbeStream helix(double taper = 0.0, double noise_mm = 1e-3) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, noise_mm);
  ProbeStream out;
  out.x_convention = XConvention{};
  for (int i = 0; i < readings; ++i) {
    const double c = two_pi * i / 36.3, z = 5.0 + i / 36.3;
    out.c_rad.push_back(c);
    out.position_mm.push_back(z);
    out.reading_mm.push_back(20.0 + taper * z + 0.06 * std::cos(c - 1.0) + noise(random));
  }
  return out;
}

void shuffle(std::vector<double>& column) {
  std::shuffle(column.begin(), column.end(), std::mt19937_64(3));
}

/// The rows in another order, all columns alike.
ProbeStream in_order(const ProbeStream& stream, const std::vector<std::size_t>& rows) {
  ProbeStream out = stream;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.reading_mm[i] = stream.reading_mm[rows[i]];
    out.c_rad[i] = stream.c_rad[rows[i]];
    out.position_mm[i] = stream.position_mm[rows[i]];
  }
  return out;
}

std::vector<std::size_t> all_rows() {
  std::vector<std::size_t> rows(readings);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

// Out, and back with the spindle reversed, at four readings per revolution: the steps of +85° and
// −85° add up to nothing, as random ones do.
TEST(ColumnOrder, AReversedSpindleIsNoShuffledColumn) {
  ProbeStream stream = helix();
  for (std::size_t i = 0; i < stream.c_rad.size(); ++i) {
    const std::size_t way = std::min(i, stream.c_rad.size() - 1 - i);
    const double back = way < i ? 0.3 : 0.0;
    stream.c_rad[i] = 85.0 * rad_per_deg * static_cast<double>(way) + back;
    stream.position_mm[i] = 0.05 * static_cast<double>(way) + back;
  }
  EXPECT_EQ(column_out_of_order(stream), "");
  shuffle(stream.c_rad);
  EXPECT_NE(column_out_of_order(stream), "");
}

TEST(ColumnOrder, OneColumnShuffledOrSortedIsNamed) {
  ProbeStream c = helix(), z = helix(), x = helix(), falling = helix();
  shuffle(c.c_rad);
  shuffle(z.position_mm);
  std::ranges::sort(x.reading_mm);
  std::ranges::sort(falling.reading_mm, std::greater{});
  EXPECT_TRUE(column_out_of_order(c).starts_with("C jumps at random")) << column_out_of_order(c);
  EXPECT_TRUE(column_out_of_order(z).starts_with("Z jumps at random")) << column_out_of_order(z);
  for (const ProbeStream& sorted : {x, falling})
    EXPECT_TRUE(column_out_of_order(sorted).starts_with("X_M never turns back"));
}

TEST(ColumnOrder, RowsMayBeInAnyOrder) {
  const ProbeStream stream = helix();
  std::vector<std::size_t> shuffled = all_rows(), by_x = shuffled, by_angle = shuffled;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(5));
  std::ranges::sort(by_x, {}, [&](std::size_t i) { return stream.reading_mm[i]; });
  std::ranges::sort(by_angle, {},
                    [&](std::size_t i) { return std::fmod(stream.c_rad[i], two_pi); });
  for (const auto& rows : {all_rows(), shuffled, by_x})
    EXPECT_EQ(column_out_of_order(in_order(stream, rows)), "");
  ProbeStream wrapped = in_order(stream, by_angle);
  for (double& c : wrapped.c_rad) c = std::fmod(c, two_pi);
  EXPECT_EQ(column_out_of_order(wrapped), "");
}

TEST(ColumnOrder, OrdinaryStreamsPass) {
  // A steep cone whose readings never turn back: the eccentricity makes less than the taper.
  EXPECT_EQ(column_out_of_order(helix(1.0, 5e-4)), "");
  ProbeStream rounded = helix(1.0, 0.0);
  for (double& x : rounded.reading_mm) x = 0.05 * std::floor(x / 0.05);
  EXPECT_EQ(column_out_of_order(rounded), "");
  // Touches at twelve angles and ten places, in a random order.
  ProbeStream touches = helix();
  std::mt19937_64 random(2);
  for (std::size_t i = 0; i < touches.size(); ++i) {
    touches.c_rad[i] = two_pi * static_cast<double>(random() % 12) / 12.0;
    touches.position_mm[i] = static_cast<double>(i / 90);
  }
  EXPECT_EQ(column_out_of_order(touches), "");
}

TEST(UnitChanges, APassThatTurnsBackNearZeroHasNoOtherSign) {
  ProbeStream down_and_up = helix(), mirrored = helix();
  for (std::size_t i = 0; i < readings; ++i) {
    const double step = 0.25, k = static_cast<double>(i);
    const bool back = i >= readings / 2;  // it begins at 0, where the one before ended at 0.97
    down_and_up.position_mm[i] =
        back ? step * (k - readings / 2) : 0.97 + step * (readings / 2 - 1 - k);
    if (back) mirrored.position_mm[i] *= -1.0;
  }
  EXPECT_EQ(unit_changes(down_and_up), "");
  EXPECT_TRUE(unit_changes(mirrored).find("(its sign)") != std::string::npos);
}

// Sections of two turns and a half reading: a turn before the third begins lies in two of them.
TEST(UnitChanges, ASectionOfTwiceTheRadiusIsNotInAnotherUnit) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 2e-4);
  ProbeStream cone;
  cone.x_convention = XConvention{};
  for (int i = 0; i < 4 * 213; ++i) {
    const int section = i / 213;
    const double c = -two_pi * (i % 213) / 106.5 + 2.0 * section;
    cone.c_rad.push_back(c - 4.0 * std::numbers::pi * section);
    cone.position_mm.push_back(8.2 * section);
    cone.pass.push_back(section + 1);
    cone.reading_mm.push_back(0.1 + 2.9 * section + 0.055 * std::cos(c) + noise(random));
  }
  EXPECT_EQ(unit_changes(cone), "");
  ProbeStream doubled = helix();
  for (std::size_t i = readings / 2; i < readings; ++i) doubled.reading_mm[i] *= 2.0;
  EXPECT_TRUE(unit_changes(doubled).find("(radius and diameter)") != std::string::npos);
}

// A taper of 0.12 mm per revolution, then a seat of nearly half the radius with the same axis: the
// step is within three of the taper's, but the eccentricity is not half. Halved readings have that
// as well.
TEST(UnitChanges, ATaperAndASeatOfHalfItsRadiusAreOneUnit) {
  std::mt19937_64 random(12);
  std::normal_distribution<double> noise(0.0, 5e-4);
  ProbeStream shaft;
  shaft.x_convention = XConvention{};
  for (int i = 0; i < 972; ++i) {
    const double turns = i / 24.3;
    shaft.c_rad.push_back(two_pi * turns);
    shaft.position_mm.push_back(turns);
    shaft.reading_mm.push_back((i < 486 ? 36.0 + 0.12 * turns : 19.1 + 0.12 * (turns - 20.0)) +
                               0.05 * std::cos(two_pi * turns) + noise(random));
  }
  EXPECT_EQ(unit_changes(shaft), "");
  ProbeStream halved = shaft;
  for (std::size_t i = 0; i < 972; ++i) {
    halved.reading_mm[i] -= i < 486 ? 0.0 : 19.1 - 38.4;
    if (i >= 486) halved.reading_mm[i] *= 0.5;
  }
  EXPECT_TRUE(unit_changes(halved).find("(radius and diameter)") != std::string::npos);
}

TEST(ColumnOrder, ASensorAtItsLimitIsSeenAndAQuantisedOneIsNot) {
  ProbeStream clipped = helix(), rounded = helix(0.0, 0.0);
  for (double& x : clipped.reading_mm) x = std::min(x, 20.04);
  for (double& x : rounded.reading_mm) x = 1e-3 * std::round(x / 1e-3);
  const LimitsMet met = limits_met(clipped);
  EXPECT_TRUE(met.saturates);
  EXPECT_EQ(met.high_mm, 20.04);
  // acos(40/60)/π of a turn is above the limit, here to three standard deviations of the count.
  const double expected = readings * std::acos(40.0 / 60.0) / std::numbers::pi;
  EXPECT_NEAR(static_cast<double>(met.at_high), expected, 3.0 * std::sqrt(expected));
  EXPECT_FALSE(limits_met(helix()).saturates);
  EXPECT_FALSE(limits_met(rounded).saturates);
}

}  // namespace
}  // namespace trueaxis
