// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"

namespace trueaxis::testing {
namespace {

double largest_difference(const AxisPositions& a, const AxisPositions& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < axis_count; ++k) largest = std::fmax(largest, std::fabs(a[k] - b[k]));
  return largest;
}

// From the pose of drawn positions the axes come back, the first solution being the drawn one when
// it is asked for the nearest to it; every solution has tip and direction by the matrices. Some
// 2000 mm after a division by a sine above 0.01: 20 · 2000 · 2⁻⁵³ / 0.01 = 4e-10.
TEST(MachineAxesLaw, PutTheToolWhereItWas) {
  const ErrorModel none;
  for (const Layout& layout : layouts()) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      Draw draw(seed);
      const Machine machine = draw.machine(layout);
      const MachineModel model(machine);
      const Setting setting = first_setting(machine);
      const AxisPositions q = draw.positions(machine);
      const ToolPose pose = model.nominal(q, setting);
      const ToolTarget target{pose.tip_mm, pose.direction};
      const InverseKinematics found = axes_for(model, target, q, setting);
      const std::string said =
          std::string(layout.name) + " seed " + std::to_string(seed) + ' ' + literal(q);
      ASSERT_FALSE(found.solutions.empty()) << said << ' ' << found.why_none;
      EXPECT_LT(largest_difference(found.solutions.front(), q), 1e-9) << said;
      for (const AxisPositions& axes : found.solutions) {
        const Matrix4 tool = ChainMatrices{machine, none}.tool_in_part(axes, setting);
        EXPECT_LT(distance(tip_of(tool), target.tip_mm), 1e-9) << said << literal(axes);
        EXPECT_LT(distance(turned(tool, machine.tool.direction), target.direction), 1e-9)
            << said << literal(axes);
      }
      if (machine.rotary_count() >= 2 && machine.linear_count() == 3) {
        EXPECT_EQ(found.solutions.size(), 2u) << said;
      }
    }
  }
}

Machine trunnion() {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.axes = parse_chain("w C' A' Y' b X Z t", none);
  return machine;
}

TEST(MachineAxesLaw, EveryTurnWithinTheLimits) {
  Machine machine = trunnion();
  for (MachineAxis& axis : machine.axes)
    if (axis.name == AxisName::C) axis.low = -400 * rad_per_deg, axis.high = 400 * rad_per_deg;
  const MachineModel model(machine);
  AxisPositions q{10, 20, 30, -0.5, 0, 0.3};
  const ToolPose pose = model.nominal(q, {});
  // A = ∓0.5, C = 0.3 + 180° k: 17.2° and ±342.8° (−342.8, 17.2, 377.2) and 197.2°, −162.8°.
  EXPECT_EQ(axes_for(model, {pose.tip_mm, pose.direction}, q, {}).solutions.size(), 5u);
  for (MachineAxis& axis : machine.axes)
    if (axis.name == AxisName::A) axis.low = -1.0, axis.high = 0.0;
  EXPECT_EQ(axes_for(MachineModel(machine), {pose.tip_mm, pose.direction}, q, {}).solutions.size(),
            3u);
}

TEST(MachineAxesLaw, AtAPoleTheFreeAxisStays) {
  const Machine machine = trunnion();
  const MachineModel model(machine);
  AxisPositions near{};
  near[index_of(AxisName::C)] = 1.25;
  const InverseKinematics found = axes_for(model, {{5, 6, 7}, {0, 0, 1}}, near, {});
  ASSERT_FALSE(found.solutions.empty());
  EXPECT_EQ(found.solutions.front()[index_of(AxisName::C)], 1.25);
  EXPECT_EQ(found.solutions.front()[index_of(AxisName::A)], 0.0);
}

// Close to a pole the two cones nearly touch: 1e-8 rad off it the direction is still exact.
TEST(MachineAxesLaw, NearAPoleTheDirectionIsExact) {
  const Machine machine = trunnion();
  const MachineModel model(machine);
  for (const double tilt : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const Vector3 direction{tilt * std::cos(0.7), tilt * std::sin(0.7), std::sqrt(1 - tilt * tilt)};
    const InverseKinematics found = axes_for(model, {{5, 6, 7}, direction}, {}, {});
    ASSERT_FALSE(found.solutions.empty()) << tilt;
    for (const AxisPositions& axes : found.solutions)
      EXPECT_LT(angle_between_rad(model.nominal(axes, {}).direction, direction), 1e-9) << tilt;
  }
}

TEST(MachineAxesLaw, SaysWhatIsOutOfReach) {
  Machine machine = trunnion();
  for (MachineAxis& axis : machine.axes)
    if (axis.name == AxisName::X) axis.low = -10, axis.high = 10;
  const InverseKinematics outside =
      axes_for(MachineModel(machine), {{50, 0, 0}, {0, 0, 1}}, {}, {});
  EXPECT_TRUE(outside.solutions.empty());
  EXPECT_NE(outside.why_none.find("X at 50.000000 mm is outside its limits -10 to 10"),
            std::string::npos)
      << outside.why_none;
  std::vector<ChainTrouble> none;
  machine.axes = parse_chain("w A' b X Y Z t", none);
  EXPECT_TRUE(axes_for(MachineModel(machine), {{0, 0, 0}, {1, 0, 0}}, {}, {}).solutions.empty());
}

TEST(MachineAxesLaw, TipWithRotaryAxesAsTheyAre) {
  for (const Layout& layout : layouts()) {
    Draw draw(5);
    const Machine machine = draw.machine(layout);
    const MachineModel model(machine);
    const Setting setting = first_setting(machine);
    AxisPositions q = draw.positions(machine);
    const ToolPose pose = model.nominal(q, setting);
    AxisPositions moved = q;
    for (std::size_t k = 0; k < 3; ++k) moved[k] += 100.0;
    const auto back = axes_for_tip(model, pose.tip_mm, moved, setting);
    ASSERT_EQ(back.has_value(), machine.linear_count() == 3) << layout.name;
    if (back) {
      EXPECT_LT(largest_difference(*back, q), 1e-10) << layout.name;
    }
  }
}

}  // namespace
}  // namespace trueaxis::testing
