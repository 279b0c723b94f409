// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "support/places.hpp"

namespace trueaxis {
namespace {

const std::string data = places::source() + "/data/five_axis/";
constexpr double half_digit = 0.5e-12;  ///< of twelve decimals

// The numbers of machine.md, computed once with numpy by multiplying 4×4 matrices out and
// solving for the axes with differences: to their last printed digit.
class WorkedExample : public ::testing::Test {
 protected:
  WorkedExample() : file(read_machine_toml(data + "trunnion_ac.toml")) {
    const std::string errors[] = {data + "trunnion_ac_errors.toml"};
    model_errors = read_errors(errors, file);
    setting = first_setting(file.machine);
  }
  static void expect_near(const Vector3& got, const Vector3& wanted) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], half_digit) << i;
  }
  /// mm and degrees of X Y Z A C.
  static void expect_axes(const AxisPositions& got, const std::array<double, 5>& wanted) {
    const std::array<double, 5> at_edge{got[0], got[1], got[2], got[3] / rad_per_deg,
                                        got[5] / rad_per_deg};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(at_edge[i], wanted[i], half_digit) << i;
  }

  MachineFile file;
  ErrorModel model_errors;
  Setting setting;
  const AxisPositions q{100, -50, 30, -35 * rad_per_deg, 0, 70 * rad_per_deg};
};

TEST_F(WorkedExample, ErrorsAtThePosition) {
  const auto value = [&](const char* name) {
    return model_errors.value(*parse_error_name(name), q);
  };
  EXPECT_NEAR(value("EXX"), 7.5e-3, 0.5e-15);
  EXPECT_NEAR(value("EYC"), -3.498754496286e-3, half_digit * 1e-3);
  EXPECT_NEAR(value("EBY"), 10e-6, 1e-18);
  EXPECT_NEAR(value("EAC"), 8.118664537186e-6, half_digit * 1e-6);
  EXPECT_NEAR(value("EAA"), -5.444444444444e-6, half_digit * 1e-6);
}

TEST_F(WorkedExample, NominalAndActual) {
  const MachineModel model(file.machine, model_errors);
  const ToolPose nominal = model.nominal(q, setting), actual = model.actual(q, setting);
  expect_near(nominal.tip_mm, {-1.865132837481, 97.227949581144, 59.197672791717});
  expect_near(nominal.direction, {-0.538985544696, 0.196174694969, 0.819152044289});
  expect_near(actual.tip_mm, {-1.850358534818, 97.210312596243, 59.190929118170});
  expect_near(actual.direction, {-0.538789781840, 0.196618406978, 0.819174446026});
  EXPECT_NEAR(about_tool_axis_rad(actual, nominal) / rad_per_deg, -0.037854821627, half_digit);
}

TEST_F(WorkedExample, SignOfTheMovingPart) {
  model_errors.sign = ErrorSign::moving_part;
  expect_near(MachineModel(file.machine, model_errors).actual(q, setting).tip_mm,
              {-1.858409759429, 97.211973233177, 59.192140290498});
}

TEST_F(WorkedExample, Exact) {
  const CompensatedPosition result =
      compensate_exactly(MachineModel(file.machine, model_errors), q, setting);
  EXPECT_EQ(result.status, CompensationStatus::compensated);
  expect_axes(result.axes, {100.036035271450, -50.057104763753, 29.968440016353, -35.002238418994,
                            70.048338174086});
  EXPECT_NEAR(result.about_tool_axis_rad / rad_per_deg, 0.001740449, 0.5e-9);
  EXPECT_LT(result.tip_left_mm, 1e-12);
  EXPECT_LT(result.direction_left_rad, 1e-14);
}

TEST_F(WorkedExample, Differential) {
  const CompensatedPosition result =
      compensate_by_differential(MachineModel(file.machine, model_errors), q, setting);
  expect_axes(result.axes, {100.036100964055, -50.057097679454, 29.968446528073, -35.002237731207,
                            70.048341453954});
  EXPECT_NEAR(result.tip_left_mm * 1e6, 65.0, 0.5);
  EXPECT_NEAR(result.direction_left_rad * 1e9, 35.0, 0.5);
}

// Joint positions that LinuxCNC 2.9 itself went to for X10.5 Y-20.25 Z30.125 C-70.25.
TEST(LinuxcncXyzac, JointsOfAPoint) {
  Machine machine = read_machine_toml(data + "xyzac_trt.toml").machine;
  AxisPositions q{0, 0, 0, -33.5 * rad_per_deg, 0, -70.25 * rad_per_deg};
  const auto joints = [&] {
    return axes_for_tip(MachineModel(machine), {10.5, -20.25, 30.125}, q, {});
  };
  ASSERT_TRUE(joints());
  EXPECT_NEAR((*joints())[0], -15.510688770, 0.5e-9);
  EXPECT_NEAR((*joints())[1], 0.483140175, 0.5e-9);
  EXPECT_NEAR((*joints())[2], 47.051927203, 0.5e-9);
  for (MachineAxis& axis : machine.axes) axis.point_mm = {};
  EXPECT_NEAR((*joints())[0], -15.510688769907, 0.5e-12);
  EXPECT_NEAR((*joints())[1], 2.680226469316, 0.5e-12);
  EXPECT_NEAR((*joints())[2], 34.352045717195, 0.5e-12);
}

}  // namespace
}  // namespace trueaxis
