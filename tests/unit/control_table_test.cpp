// SPDX-License-Identifier: Apache-2.0
// Files for controls, read back by readers of this test and held against the cylinder itself: its
// axis passes through q = (a, b, 0) along d = (p, q, 1)/|…|, and the point X (cos C, sin C, 0) + Z
// of the probe's line is on it where |v|² − (v·d)² = R², v from q to the point: a quadratic in X.
// Tolerance: half the last digit that the format has, and 1e-12 mm of arithmetic.
#include "trueaxis/control_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "trueaxis/correction.hpp"

namespace trueaxis::testing {
namespace {

constexpr double a_mm = 0.08, b_mm = -0.05, slope_x = 4e-4, slope_y = -3e-4, radius_mm = 30.0;
constexpr double feed_mm = 0.5, z_start_mm = 130.0, z_end_mm = 100.0;

double wanted_mm(double c_rad, double z_mm) {
  const double length = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  const std::array<double, 3> d{slope_x / length, slope_y / length, 1.0 / length};
  const std::array<double, 3> e{std::cos(c_rad), std::sin(c_rad), 0.0}, w{-a_mm, -b_mm, z_mm};
  const auto dot = [](const auto& u, const auto& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  // (1 − (e·d)²) X² + 2 (e·w − (e·d)(w·d)) X + |w|² − (w·d)² − R² = 0
  const double ed = dot(e, d), wd = dot(w, d);
  const double two = 1.0 - ed * ed, one = dot(e, w) - ed * wd;
  const double none = dot(w, w) - wd * wd - radius_mm * radius_mm;
  return (-one + std::sqrt(one * one - two * none)) / two - radius_mm;
}

/// Its eccentricity at the end of the cut that has more.
double most_mm() {
  return std::max(std::hypot(a_mm + 100.0 * slope_x, b_mm + 100.0 * slope_y),
                  std::hypot(a_mm + 130.0 * slope_x, b_mm + 130.0 * slope_y));
}

/// Where the tool is along Z in row i of the cut: at its end the feed stops.
double z_of_row(std::size_t i) {
  return std::max(z_end_mm, z_start_mm - feed_mm * static_cast<double>(i) / 360.0);
}

Correction correction(bool precompensate = false) {
  AxisEstimate axis;
  axis.axis = {a_mm, b_mm, slope_x, slope_y, 0.0};
  TargetSurface target;
  target.radius_mm = radius_mm;
  target.z_start_mm = z_start_mm;
  target.z_end_mm = z_end_mm;
  ToolSetup tool;
  tool.feed_mm_per_rev = feed_mm;
  Actuator actuator;
  actuator.precompensate = precompensate;
  return make_correction(axis, target, tool, actuator);
}

ControlTable table_of(ControlFormat format) {
  ControlTable table;
  table.format = format;
  table.position_step_mm = 5.0;
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(std::string line) {
  for (char& c : line)
    if (std::string_view("0123456789.-+").find(c) == std::string_view::npos) c = ' ';
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double value = 0.0; in >> value;) numbers.push_back(value);
  return numbers;
}

TEST(ControlTables, TheGridIsTheCircle) {
  const MadeControlTable made = make_control_table(correction(), table_of(ControlFormat::grid));
  std::size_t values = 0;
  for (const std::string& line : lines_of(made.text)) {
    if (line.starts_with('#') || line.starts_with("C[")) continue;
    const std::vector<double> row = numbers_of(line);
    ASSERT_EQ(row.size(), 8U);  // an angle, 100 to 130 mm by 5
    for (std::size_t j = 1; j < row.size(); ++j, ++values)
      EXPECT_NEAR(row[j] * mm_per_um,
                  wanted_mm(row[0] * rad_per_deg, 95.0 + 5.0 * static_cast<double>(j)),
                  made.rounding_mm + 1e-12);
  }
  EXPECT_EQ(values, 361U * 7U);
  // Linear over 1° of one undulation: (1°)²/8 of its amplitude, at the cut's end that has more.
  const double chord_mm = most_mm() * rad_per_deg * rad_per_deg / 8.0;
  EXPECT_NEAR(made.off.largest_mm, chord_mm, 0.01 * chord_mm + made.rounding_mm);
  // A chord leaves sinc² of its wave, 1 − (1°)²/12: two thirds of what it is off in the middle.
  EXPECT_NEAR(made.off.once_mm, chord_mm * 2.0 / 3.0, 0.01 * chord_mm + made.rounding_mm);
}

TEST(ControlTables, TheStreamIsTheTableAndItsLastLineTwice) {
  const Correction of = correction();
  const MadeControlTable made = make_control_table(of, table_of(ControlFormat::halstreamer));
  std::vector<std::vector<double>> rows;
  for (const std::string& line : lines_of(made.text))
    if (!line.starts_with('#')) rows.push_back(numbers_of(line));
  ASSERT_EQ(rows.size(), of.rows.wanted_mm.size() + 1);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    EXPECT_NEAR(rows[i][1], static_cast<double>(i), 1e-6);  // 360 rows per revolution
    EXPECT_NEAR(rows[i][0] * mm_per_um, wanted_mm(rows[i][1] * rad_per_deg, z_of_row(i)),
                made.rounding_mm + 1e-12);
  }
  EXPECT_EQ(rows.back(), rows[rows.size() - 2]);
  // Held for 1°, a wave is up to that off, and half of it late.
  const double step_mm = most_mm() * rad_per_deg;
  EXPECT_NEAR(made.off.largest_mm, step_mm, 0.01 * step_mm);
  EXPECT_NEAR(made.off.once_mm, 0.5 * step_mm, 0.01 * step_mm);
}

// Ahead of a lag of 2ζ/ω_n + T/2 = 0.40 ms at 600 rpm, 1.4°: 0.18 mm times that, 4.5 µm.
TEST(ControlTables, TheStreamIsWhatTheActuatorIsSent) {
  const Correction of = correction(true);
  const MadeControlTable made = make_control_table(of, table_of(ControlFormat::halstreamer));
  EXPECT_NE(made.text.find("X_command in um (precompensated)"), std::string::npos);
  double largest_mm = 0.0;
  std::size_t i = 0;
  for (const std::string& line : lines_of(made.text)) {
    if (line.starts_with('#') || i == of.rows.command_mm.size()) continue;
    EXPECT_NEAR(numbers_of(line)[0] * mm_per_um, of.rows.command_mm[i], made.rounding_mm + 1e-12);
    largest_mm = std::max(largest_mm, std::abs(of.rows.command_mm[i] - of.rows.wanted_mm[i]));
    ++i;
  }
  EXPECT_GT(largest_mm, 1e-3);
}

TEST(ControlTables, ProgramsSayRadiusAndDiameterAndBothFeeds) {
  for (const bool diameter : {false, true}) {
    ControlTable table = table_of(ControlFormat::servo_nc);
    table.x_is_diameter = table.minutes = diameter;
    table.head = "%\nO7 (MINE)\nG55\n";
    table.tail = "M29\n";
    const MadeControlTable made = make_control_table(correction(), table);
    ASSERT_TRUE(made.text.starts_with("%\nO7 (MINE)\n( schema: ")) << made.text.substr(0, 60);
    const std::vector<std::string> lines = lines_of(made.text.substr(12));
    EXPECT_EQ(lines[3], "G55");
    EXPECT_EQ(lines.back(), "M29");
    std::size_t blocks = 0;
    for (std::string line : lines) {
      const bool first = line.starts_with("G1 ");
      if (first) line = line.substr(3);
      if (!line.starts_with('C')) continue;
      const std::vector<double> word = numbers_of(line);
      ASSERT_EQ(word.size(), 4U) << line;  // C X Z F
      const double scale = diameter ? 2.0 : 1.0;
      EXPECT_NEAR(word[1] / scale, radius_mm + wanted_mm(word[0] * rad_per_deg, z_of_row(blocks)),
                  made.rounding_mm + 1e-12);
      EXPECT_NEAR(word[2], z_of_row(blocks), 0.5e-6 + 1e-12);
      // To the start at the feed of the cut, 600 rpm and 0.5 mm; then 360 blocks a turn.
      if (first)
        EXPECT_NEAR(word[3], 300.0, 1e-9);
      else
        EXPECT_NEAR(word[3], diameter ? 1.0 / 216000.0 : 216000.0, diameter ? 1e-12 : 1e-9);
      ++blocks;
    }
    EXPECT_EQ(blocks, correction().rows.wanted_mm.size());
    const double chord_mm = most_mm() * rad_per_deg * rad_per_deg / 8.0;
    EXPECT_NEAR(made.off.largest_mm, chord_mm, 0.01 * chord_mm + made.rounding_mm);
    // Inverse time holds for the blocks of the cut and for nothing else; the first block says in a
    // comment where the nose must be, and only feeds there.
    ASSERT_TRUE(lines[7].starts_with("G1 C")) << lines[7];
    EXPECT_NE(lines[4].find(lines[7].substr(3, lines[7].find(" F") - 3)), std::string::npos);
    EXPECT_EQ(lines[6], "G94");
    EXPECT_EQ(lines[8], "G93");
    EXPECT_EQ(lines[lines.size() - 2], "G94");
  }
}

TEST(ControlTables, SinumerikHasATableForEachBand) {
  ControlTable table = table_of(ControlFormat::sinumerik_cec);
  table.c_step_rad = 2.0 * rad_per_deg;
  table.position_step_mm = 10.0;
  const MadeControlTable made = make_control_table(correction(), table);
  std::array<int, 3> points{};
  for (const std::string& line : lines_of(made.text)) {
    if (!line.starts_with("$AN_CEC[")) continue;
    const std::vector<double> n = numbers_of(line);  // table, point, value
    ++points.at(static_cast<std::size_t>(n[0]));
    const double middle_mm = z_end_mm + 10.0 * n[0] + 5.0;
    EXPECT_NEAR(n[2], wanted_mm(n[1] * 2.0 * rad_per_deg, middle_mm), made.rounding_mm + 1e-12);
  }
  EXPECT_EQ(points, (std::array{181, 181, 181}));
  for (const char* said : {"$AN_CEC_IS_MODULO[2]=1\n", "$AN_CEC_STEP[1]=2.000000\n",
                           "; table 2: Z 110.0000 to 120.0000\n"})
    EXPECT_NE(made.text.find(said), std::string::npos) << said;
  // Off by what the axis leans over half a band, which turns once per revolution; the chord over 2°
  // is less than its (2°)²/8.
  const double leans_mm = 5.0 * std::hypot(slope_x, slope_y);
  const double chord_mm = 0.2 * 4.0 * rad_per_deg * rad_per_deg / 8.0;
  EXPECT_NEAR(made.off.largest_mm, leans_mm, chord_mm + made.rounding_mm);
  EXPECT_NEAR(made.off.once_mm, leans_mm, chord_mm + made.rounding_mm);
}

TEST(ControlTables, BeckhoffCountsInTenthsOfAMicrometre) {
  ControlTable table = table_of(ControlFormat::beckhoff_crosscomp2);
  table.c_step_rad = 5.0 * rad_per_deg;
  table.x_axis = 4;
  table.c_axis = 5;
  table.z_axis = 6;
  const MadeControlTable made = make_control_table(correction(), table);
  std::size_t values = 0;
  for (const std::string& line : lines_of(made.text)) {
    const std::size_t at = line.find(".table[");
    if (at == std::string::npos) continue;
    const std::size_t value = line.find(".correction");
    const std::vector<double> node = numbers_of(line.substr(at + 6, value - at - 6));
    ASSERT_EQ(node.size(), 2U) << line;  // [master2][master1]
    EXPECT_NEAR(std::stod(line.substr(value + 11)) * 1e-4,
                wanted_mm(node[1] * 5.0 * rad_per_deg, z_end_mm + 5.0 * node[0]),
                made.rounding_mm + 1e-12)
        << line;
    ++values;
  }
  EXPECT_EQ(values, 73U * 7U);
  // The parameters in the order of the maker's list, in 0.1 µm and points.
  const std::map<std::string, double> said{{"kopf.achs_nr ", 4},
                                           {"crosscomp2.max_points ", 511},
                                           {"crosscomp2.interval ", 5e4},
                                           {"crosscomp2.last_index_master1 ", 72},
                                           {"last_index_master2 ", 6},
                                           {"start_position_master1 ", 0},
                                           {"start_position_master2 ", 1e6},
                                           {"master1_ax_nr ", 5},
                                           {"master2_ax_nr ", 6}};
  for (const auto& [key, number] : said) {
    const std::size_t at = made.text.find(key);
    ASSERT_NE(at, std::string::npos) << key;
    EXPECT_EQ(std::stod(made.text.substr(at + key.size())), number) << key;
  }
}

// Of an eccentricity that grows along Z its square bends: between two places 40 mm apart by
// (0.32 mm)²/8R across the lean. A zero has no sign.
TEST(ControlTables, AGridIsOffBetweenItsPlacesToo) {
  const TargetSurface cut{TargetKind::cylinder, false, 0.0, 40.0, 8.0, 0.0, 0.0, 0.0, 0.0};
  ControlTable table = table_of(ControlFormat::grid);
  table.position_step_mm = 40.0;
  const Correction leaning = make_correction({{0.0, 0.0, 8e-3, 0.0, 0.0}, {}}, cut, {}, {});
  const double bend_mm = 0.32 * 0.32 / 64.0;
  EXPECT_NEAR(make_control_table(leaning, table).off.largest_mm, bend_mm, 0.02 * bend_mm);
  table.format = ControlFormat::sinumerik_cec;
  table.c_step_rad = 2.0 * rad_per_deg;
  const std::string text = make_control_table(make_correction({}, cut, {}, {}), table).text;
  EXPECT_NE(text.find("]=0.000000\n"), std::string::npos);
  EXPECT_EQ(text.find("]=1.0"), std::string::npos);
  EXPECT_EQ(text.find("-0.0"), std::string::npos);
}

// What a control makes of a table is compared with what the table is made for: the axis as it must
// be commanded for the loop of the machine to leave the target axis.
TEST(ControlTables, TheLoopOfTheMachineIsNoDeviation) {
  const Correction of = correction();
  const LoopResponse loop{.gain = 0.02, .lag_rad = -0.03};
  const Correction looped = make_correction(of.axis, of.target, of.tool, of.actuator, {}, loop);
  const Correction commanded =
      make_correction({looped.commanded_axis(), {}}, of.target, of.tool, of.actuator);
  ASSERT_GT(std::abs(looped.rows.wanted_mm[90] - of.rows.wanted_mm[90]), 1e-3);
  for (const ControlFormat format :
       {ControlFormat::grid, ControlFormat::halstreamer, ControlFormat::servo_nc,
        ControlFormat::sinumerik_cec, ControlFormat::beckhoff_crosscomp2}) {
    ControlTable table = table_of(format);
    table.c_step_rad = table.position_step_mm * rad_per_deg;
    const MadeControlTable made = make_control_table(looped, table);
    const MadeControlTable expected = make_control_table(commanded, table);
    EXPECT_EQ(made.text, expected.text) << to_string(format);
    EXPECT_NEAR(made.off.largest_mm, expected.off.largest_mm, 1e-12) << to_string(format);
    EXPECT_NEAR(made.off.once_mm, expected.off.once_mm, 1e-12) << to_string(format);
  }
}

/// The objection to a table of this form, for a cut along 30 mm with a feed and rows per
/// revolution.
std::string objection(ControlFormat format, double c_step_deg, double step_mm,
                      double feed = feed_mm, int rows = 360) {
  ControlTable table = table_of(format);
  table.c_step_rad = c_step_deg * rad_per_deg;
  table.position_step_mm = step_mm;
  Correction of;
  of.target.radius_mm = radius_mm;
  of.target.z_start_mm = z_start_mm;
  of.target.z_end_mm = z_end_mm;
  of.tool.feed_mm_per_rev = feed;
  of.tool.rows_per_revolution = rows;
  return objection_to(table, of.target, of.tool);
}

// docs/reference/job.md: the largest of each that is made, and the next that is not.
TEST(ControlTables, EachHasItsLargest) {
  using enum ControlFormat;
  struct Edge {
    ControlFormat format;
    double c_step_deg, step_mm, feed_mm;
    int rows;
    const char* said;  ///< empty: it is made
  };
  const Edge edges[] = {
      // 361 angles: 2770 places are 999970 values, 2771 are 1000331.
      {grid, 1.0, 30.0 / 2769.0, 0.5, 360, ""},
      {grid, 1.0, 30.0 / 2770.0, 0.5, 360, "makes 1000331 values, more than the 1000000"},
      // 30 mm in revolutions of the feed, times rows.
      {halstreamer, 1.0, 5.0, 0.0006, 999, ""},
      {halstreamer, 1.0, 5.0, 0.0006, 1001, "makes 50050000 lines, more than the 50000000"},
      {servo_nc, 1.0, 5.0, 0.03, 999, ""},
      {servo_nc, 1.0, 5.0, 0.03, 1001, "makes 1001000 blocks, more than the 1000000"},
      {sinumerik_cec, 2.0, 3.75, 0.5, 360, ""},
      {sinumerik_cec, 2.0, 3.7, 0.5, 360, "makes 9 tables, more than the 8"},
      {sinumerik_cec, 1.8, 5.0, 0.5, 360, "makes 201 points in a table, more than the 200"},
      {sinumerik_cec, 2.0, 1e-300, 0.5, 360, "makes more than the 8 tables"},
      // 721 angles: 14 places, and 10 in steps of the same number.
      {beckhoff_crosscomp2, 0.5, 0.5, 0.5, 360, "makes 43981 points, more than the 10201"},
      {beckhoff_crosscomp2, 1.0, 2.0, 0.5, 360, "has one interval for both axes"},
      {beckhoff_crosscomp2, 1.2, 1.2, 0.5, 360, ""},
      {grid, 7.0, 5.0, 0.5, 360, "does not divide a revolution"},
      {grid, 90.0, 5.0, 0.5, 360, ""},
      {grid, 120.0, 5.0, 0.5, 360, "does not divide a revolution"},
  };
  for (const Edge& edge : edges) {
    const std::string found =
        objection(edge.format, edge.c_step_deg, edge.step_mm, edge.feed_mm, edge.rows);
    if (*edge.said == '\0') {
      EXPECT_EQ(found, "") << to_string(edge.format);
    } else {
      EXPECT_NE(found.find(edge.said), std::string::npos) << to_string(edge.format) << ' ' << found;
    }
  }
}

}  // namespace
}  // namespace trueaxis::testing
