// SPDX-License-Identifier: Apache-2.0
// Files for controls, read back by readers of this test and held against the circle itself: a
// cylinder of radius R about an axis that is (a, b) off and parallel to the spindle meets the
// probe's line at X(C) = a cos C + b sin C + √(R² − (b cos C − a sin C)²). Tolerance: half the last
// digit that the format has, and 1e-12 mm of arithmetic.
#include "trueaxis/control_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "trueaxis/correction.hpp"

namespace trueaxis::testing {
namespace {

constexpr double a_mm = 0.08, b_mm = -0.05, radius_mm = 30.0;

double wanted_mm(double c_rad) {
  const double across = b_mm * std::cos(c_rad) - a_mm * std::sin(c_rad);
  return a_mm * std::cos(c_rad) + b_mm * std::sin(c_rad) +
         std::sqrt(radius_mm * radius_mm - across * across) - radius_mm;
}

Correction correction() {
  AxisEstimate axis;
  axis.axis = {a_mm, b_mm, 0.0, 0.0, 0.0};
  TargetSurface target;
  target.radius_mm = radius_mm;
  target.z_start_mm = 130.0;
  target.z_end_mm = 100.0;
  ToolSetup tool;
  tool.feed_mm_per_rev = 0.5;
  Actuator actuator;
  actuator.precompensate = false;
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
      EXPECT_NEAR(row[j] * mm_per_um, wanted_mm(row[0] * rad_per_deg), made.rounding_mm + 1e-12);
  }
  EXPECT_EQ(values, 361U * 7U);
  // Linear over 1° of one undulation: (1°)²/8 of its amplitude.
  EXPECT_LE(made.off_mm,
            std::hypot(a_mm, b_mm) * rad_per_deg * rad_per_deg / 8.0 + made.rounding_mm);
}

TEST(ControlTables, TheStreamIsTheTableAndItsLastLineTwice) {
  const Correction of = correction();
  const MadeControlTable made = make_control_table(of, table_of(ControlFormat::halstreamer));
  std::vector<std::vector<double>> rows;
  for (const std::string& line : lines_of(made.text))
    if (!line.starts_with('#')) rows.push_back(numbers_of(line));
  ASSERT_EQ(rows.size(), of.rows.wanted_mm.size() + 1);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    EXPECT_NEAR(rows[i][1], static_cast<double>(i), 1e-6);  // 360 rows a turn
    EXPECT_NEAR(rows[i][0] * mm_per_um, wanted_mm(rows[i][1] * rad_per_deg),
                made.rounding_mm + 1e-12);
  }
  EXPECT_EQ(rows.back(), rows[rows.size() - 2]);
}

TEST(ControlTables, ProgramsSayRadiusAndDiameterAndBothFeeds) {
  for (const bool diameter : {false, true}) {
    ControlTable table = table_of(ControlFormat::servo_nc);
    table.x_is_diameter = table.minutes = diameter;
    table.head = "G55\n";
    table.tail = "M29\n";
    const MadeControlTable made = make_control_table(correction(), table);
    const std::vector<std::string> lines = lines_of(made.text);
    EXPECT_EQ(lines[2], "G55");
    EXPECT_EQ(lines.back(), "M29");
    std::size_t blocks = 0;
    for (std::string line : lines) {
      if (line.starts_with("G1 ")) line = line.substr(3);
      if (!line.starts_with('C')) continue;
      const std::vector<double> word = numbers_of(line);
      ASSERT_EQ(word.size(), 4U) << line;  // C X Z F
      const double scale = diameter ? 2.0 : 1.0;
      EXPECT_NEAR(word[1] / scale, radius_mm + wanted_mm(word[0] * rad_per_deg),
                  made.rounding_mm + 1e-12);
      EXPECT_NEAR(word[2], 130.0 - 0.5 * static_cast<double>(blocks) / 360.0, 0.5e-6 + 1e-12);
      // 600 rpm and 360 blocks a turn.
      EXPECT_NEAR(word[3], diameter ? 1.0 / 216000.0 : 216000.0, diameter ? 0.5e-6 : 1e-9);
      ++blocks;
    }
    EXPECT_EQ(blocks, correction().rows.wanted_mm.size());
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
    EXPECT_NEAR(n[2], wanted_mm(n[1] * 2.0 * rad_per_deg), made.rounding_mm + 1e-12);
  }
  EXPECT_EQ(points, (std::array{181, 181, 181}));
  EXPECT_NE(made.text.find("$AN_CEC_IS_MODULO[2]=1"), std::string::npos);
}

TEST(ControlTables, BeckhoffCountsInTenthsOfAMicrometre) {
  ControlTable table = table_of(ControlFormat::beckhoff_crosscomp2);
  table.c_step_rad = 5.0 * rad_per_deg;
  const MadeControlTable made = make_control_table(correction(), table);
  std::size_t values = 0;
  for (const std::string& line : lines_of(made.text)) {
    const std::size_t at = line.find(".table[");
    if (at == std::string::npos) continue;
    const std::size_t value = line.find(".correction");
    const std::vector<double> node = numbers_of(line.substr(at + 6, value - at - 6));
    ASSERT_EQ(node.size(), 2U) << line;  // [master2][master1]
    EXPECT_NEAR(std::stod(line.substr(value + 11)) * 1e-4, wanted_mm(node[1] * 5.0 * rad_per_deg),
                made.rounding_mm + 1e-12)
        << line;
    ++values;
  }
  EXPECT_EQ(values, 73U * 7U);
  EXPECT_NE(made.text.find("kw.crosscomp2.start_position_master2   1000000\n"), std::string::npos);
}

TEST(ControlTables, LimitsAreSaidBeforeAnythingIsMade) {
  const Correction of = correction();
  ControlTable table = table_of(ControlFormat::sinumerik_cec);
  table.c_step_rad = 2.0 * rad_per_deg;
  table.position_step_mm = 3.0;  // ten bands
  EXPECT_NE(objection_to(table, of.target, of.tool).find("10 tables, more than the 8 that it can have"),
            std::string::npos);
  table.format = ControlFormat::grid;
  table.c_step_rad = 7.0 * rad_per_deg;
  EXPECT_NE(objection_to(table, of.target, of.tool).find("no whole part of a turn"),
            std::string::npos);
  table.c_step_rad = rad_per_deg;
  table.position_step_mm = 0.01;
  EXPECT_NE(objection_to(table, of.target, of.tool).find("more than the 1000000 that it can have"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis::testing
