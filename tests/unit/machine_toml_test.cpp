// SPDX-License-Identifier: Apache-2.0
#include "machine/files/machine_toml.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "machine/files/errors_files.hpp"
#include "support/command.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const char* const everything = R"(schema = "trueaxis.machine/1"
name = "all of \"it\""
chain = "[w C' B' X' b Y Z (C1) t]"
[axes.B]
direction = [0, 3, 3]
point_mm = [1, 2, 3]
limits_deg = [-30, 110]
[axes.X]
direction = [-1, 0, 0]
limits_m = [-0.5, 0.5]
[tool]
gauge_point_mm = [0, 0, 150]
direction = [0, 0, 2]
length_mm = 80
[tools.3]
length_mm = 12.5
[workpiece.G54]
origin_mm = [1, 2, 3]
[workpiece.G57]
origin_um = [1000, 0, 0]
rotation_deg = [10, 20, 30]
zero = {X = 5, C = 90}
[program]
mode = "tip"
start = "X1.5 Y-2 B+30"
[compensation]
max_rotary_change_deg = 2
)";

struct Files : ::testing::Test {
  std::string written(const std::string& name, const std::string& text) const {
    write_text(folder / name, text);
    return (folder / name).string();
  }
  const std::filesystem::path folder = fresh_folder("unit/machine_toml");
};
using MachineToml = Files;

TEST_F(MachineToml, EveryKeyIsRead) {
  const Machine machine = read_machine_toml(written("m.toml", everything)).machine;
  EXPECT_EQ(machine.name, "all of \"it\"");
  ASSERT_EQ(machine.axes.size(), 5u);
  EXPECT_EQ(machine.axes[1].name, AxisName::B);
  EXPECT_TRUE(machine.axes[2].carries_workpiece);
  EXPECT_FALSE(machine.axes[3].carries_workpiece);
  EXPECT_DOUBLE_EQ(machine.axes[1].direction[2], std::sqrt(0.5));
  EXPECT_EQ(machine.axes[1].point_mm, (Vector3{1, 2, 3}));
  EXPECT_EQ(machine.axes[1].high, 110 * rad_per_deg);
  EXPECT_EQ(machine.axes[2].low, -500.0);
  EXPECT_EQ(machine.tool.direction, (Vector3{0, 0, 1}));
  EXPECT_EQ(machine.tool_lengths_mm.at(3), 12.5);
  ASSERT_TRUE(machine.work_offsets[3]);
  EXPECT_FALSE(machine.work_offsets[1]);
  EXPECT_EQ(machine.work_offsets[3]->bed_from_program.origin_mm, (Vector3{1, 0, 0}));
  // The z axis by Rz(30)Ry(20)Rx(10), written out.
  const double a = 10 * rad_per_deg, b = 20 * rad_per_deg, c = 30 * rad_per_deg;
  const Matrix3& R = machine.work_offsets[3]->bed_from_program.rotation;
  EXPECT_NEAR(R[0][2], std::cos(c) * std::sin(b) * std::cos(a) + std::sin(c) * std::sin(a), 1e-15);
  EXPECT_NEAR(R[1][2], std::sin(c) * std::sin(b) * std::cos(a) - std::cos(c) * std::sin(a), 1e-15);
  EXPECT_NEAR(R[2][2], std::cos(b) * std::cos(a), 1e-15);
  EXPECT_EQ(machine.work_offsets[3]->zero[index_of(AxisName::C)], 90 * rad_per_deg);
  EXPECT_EQ(machine.mode, ProgramMode::tip);
  EXPECT_EQ(machine.start[index_of(AxisName::X)], 1.5);
  EXPECT_EQ(machine.start[index_of(AxisName::B)], 30 * rad_per_deg);
  EXPECT_FALSE(machine.start[index_of(AxisName::Z)]);
  EXPECT_EQ(machine.max_rotary_change_rad, 2 * rad_per_deg);
}

/// Numbers of `b` where `a` has other ones: how far off at most, in parts of 1.
double difference(const std::string& a, const std::string& b) {
  double largest = 0.0;
  std::istringstream of_a(a), of_b(b);
  for (std::string word_a, word_b; of_a >> word_a && of_b >> word_b;) {
    if (word_a == word_b) continue;
    const double x = std::atof(word_a.c_str() + (word_a[0] == '[')),
                 y = std::atof(word_b.c_str() + (word_b[0] == '['));
    largest = std::max(largest, std::abs(x - y) / (1.0 + std::abs(x)));
  }
  return largest;
}

// A number in degrees or µm may come back a rounding off, 2⁻⁵².
TEST_F(MachineToml, WhatIsWrittenIsReadBack) {
  const Machine machine = read_machine_toml(written("m.toml", everything)).machine;
  const std::string once = machine_toml(machine);
  const std::string twice = machine_toml(read_machine_toml(written("n.toml", once)).machine);
  EXPECT_EQ(once.size(), twice.size());
  EXPECT_LT(difference(once, twice), 1e-15) << once << twice;
}

TEST_F(MachineToml, ErrorsThatAreWrittenAreReadBack) {
  const std::string data = places::source() + "/data/five_axis/";
  const Machine machine = read_machine_toml(data + "trunnion_ac.toml").machine;
  ErrorModel errors = read_errors_toml(data + "trunnion_ac_errors.toml", machine);
  errors.terms.front().u = 2e-3;
  const ErrorModel back = read_errors_toml(written("e.toml", errors_toml(errors)), machine);
  EXPECT_EQ(back.sign, errors.sign);
  EXPECT_EQ(back.reference_mm, errors.reference_mm);
  ASSERT_EQ(back.terms.size(), errors.terms.size());
  EXPECT_NEAR(back.terms.front().u, 2e-3, 1e-18);
  for (std::size_t i = 0; i < back.terms.size(); ++i) {
    EXPECT_EQ(back.terms[i].name, errors.terms[i].name);
    for (const double q : {-1.7, -0.3, 0.0, 0.4, 55.0})
      EXPECT_NEAR(value_at(back.terms[i].function, q), value_at(errors.terms[i].function, q),
                  1e-17 + 1e-14 * std::abs(value_at(errors.terms[i].function, q)))
          << to_string(back.terms[i].name) << q;
  }
}

}  // namespace
}  // namespace trueaxis::testing
