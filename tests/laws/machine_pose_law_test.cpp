// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"

namespace trueaxis::testing {
namespace {

constexpr std::uint64_t seeds = 40;

struct Difference {
  double tip_mm = 0.0, rotation = 0.0;
};

/// The largest differences between the room and the matrices, over drawn positions.
Difference compare(const Layout& layout, std::uint64_t seed, double length_mm, double angle_rad,
                   Planted planted = Planted::none) {
  Draw draw(seed);
  const Machine machine = draw.machine(layout);
  const ErrorModel errors = draw.errors(machine, length_mm, angle_rad);
  const MachineModel model(machine, errors);
  const Setting setting = first_setting(machine);
  const ChainMatrices matrices{machine, errors, planted};
  Difference largest;
  for (int i = 0; i < 10; ++i) {
    const AxisPositions q = draw.positions(machine);
    const ToolPose pose = model.actual(q, setting);
    const Matrix4 tool = matrices.tool_in_part(q, setting);
    const double tip = distance(pose.tip_mm, tip_of(tool)),
                 rotation = rotation_distance(tool, pose.rotation),
                 direction = distance(pose.direction, turned(tool, machine.tool.direction));
    largest.tip_mm = std::max(largest.tip_mm, tip);
    largest.rotation = std::max({largest.rotation, rotation, direction});
    if (planted == Planted::none) {
      EXPECT_LT(tip, 1e-11) << layout.name << " seed " << seed << ' ' << literal(q);
      EXPECT_LT(std::max(rotation, direction), 1e-13)
          << layout.name << " seed " << seed << ' ' << literal(q);
    }
  }
  return largest;
}

// Lengths of some 2 m in ten to twenty multiplications: 20 · 2000 mm · 2⁻⁵³ = 4e-12 mm.
TEST(MachinePoseLaw, AgreesWithMatricesMultipliedOut) {
  for (const Layout& layout : layouts())
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) compare(layout, seed, 0.2, 2e-3);
}

TEST(MachinePoseLaw, AgreesForErrorsThatAreNotSmall) {
  for (const Layout& layout : layouts())
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) compare(layout, 1000 + seed, 5.0, 0.3);
}

TEST(MachinePoseLaw, NominalIsWithoutErrors) {
  for (const Layout& layout : layouts()) {
    Draw draw(7);
    const Machine machine = draw.machine(layout);
    const MachineModel model(machine, draw.errors(machine, 0.2, 2e-3));
    const Setting setting = first_setting(machine);
    const ErrorModel none;
    for (int i = 0; i < 20; ++i) {
      const AxisPositions q = draw.positions(machine);
      const ToolPose pose = model.nominal(q, setting);
      const Matrix4 tool = ChainMatrices{machine, none}.tool_in_part(q, setting);
      EXPECT_LT(distance(pose.tip_mm, tip_of(tool)), 1e-11) << layout.name << literal(q);
      EXPECT_LT(rotation_distance(tool, pose.rotation), 1e-13) << layout.name << literal(q);
    }
  }
}

// The test of the test: it notices what a reader of the formulas could get wrong. With errors of
// the size of a machine's (20 µm, 50 µrad) that is a thousand times above the tolerance at least.
TEST(MachinePoseLaw, SeesPlantedMistakes) {
  const Layout &trunnion = layouts().front(), &three = layouts()[7];
  for (const Planted planted :
       {Planted::sign_of_workpiece, Planted::order_of_turns, Planted::errors_after_rotary,
        Planted::pivot_of_linear, Planted::pivot_of_spindle, Planted::bodies_from_tool}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      EXPECT_GT(compare(trunnion, seed, 0.02, 5e-5, planted).tip_mm, 1e-8)
          << static_cast<int>(planted) << " seed " << seed;
    }
  }
  EXPECT_GT(compare(three, 1, 0.02, 5e-5, Planted::sign_of_workpiece).tip_mm, 1e-8);
}

/// Central differences of the nominal matrices: h² · 1000 mm / 6 + 2e-13 mm / h for h = 1e-4.
TEST(MachineJacobianLaw, AgreesWithDifferences) {
  const double h = 1e-4;
  for (const Layout& layout : layouts()) {
    Draw draw(11);
    const Machine machine = draw.machine(layout);
    const MachineModel model(machine);
    const Setting setting = first_setting(machine);
    for (int i = 0; i < 10; ++i) {
      const AxisPositions q = draw.positions(machine);
      const ToolJacobian columns = model.jacobian(q, setting);
      for (const MachineAxis& axis : machine.axes) {
        const std::size_t k = index_of(axis.name);
        AxisPositions above = q, below = q;
        above[k] += h;
        below[k] -= h;
        const ToolDisplacement moved =
            displacement(model.nominal(above, setting), model.nominal(below, setting));
        for (std::size_t n = 0; n < 3; ++n) {
          EXPECT_NEAR(columns[k].tip_mm[n], moved.tip_mm[n] / (2 * h), 1e-5) << layout.name;
          EXPECT_NEAR(columns[k].rotation_rad[n], moved.rotation_rad[n] / (2 * h), 1e-8)
              << layout.name;
        }
      }
    }
  }
}

/// L is the derivative by the size of all errors: central differences of the actual tool with
/// errors of ± 1e-3 of their size leave the third order, (1e-3)² · 0.3 mm.
TEST(MachineLinearErrorLaw, IsTheDifferentialOfAllErrors) {
  for (const Layout& layout : layouts()) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Draw draw(seed);
      const Machine machine = draw.machine(layout);
      const ErrorModel errors = draw.errors(machine, 0.02, 5e-5);
      const auto scaled = [&](double factor) {
        ErrorModel model = errors;
        for (ErrorTerm& term : model.terms) {
          std::visit(
              [&](auto& kind) {
                using Kind = std::decay_t<decltype(kind)>;
                if constexpr (std::is_same_v<Kind, ConstantError>) kind.value *= factor;
                if constexpr (std::is_same_v<Kind, PolynomialError>)
                  for (double& c : kind.coefficients) c *= factor;
                if constexpr (std::is_same_v<Kind, FourierError>)
                  for (auto& one : kind.terms) one.cos *= factor, one.sin *= factor;
                if constexpr (std::is_same_v<Kind, TableError>)
                  for (double& v : kind.values) v *= factor;
              },
              term.function);
        }
        return MachineModel(machine, model);
      };
      const double h = 1e-2;
      const Setting setting = first_setting(machine);
      const MachineModel above = scaled(h), below = scaled(-h);
      for (int i = 0; i < 5; ++i) {
        const AxisPositions q = draw.positions(machine);
        const ToolDisplacement L = MachineModel(machine, errors).linear_error(q, setting);
        const ToolDisplacement moved =
            displacement(above.actual(q, setting), below.actual(q, setting));
        for (std::size_t n = 0; n < 3; ++n) {
          EXPECT_NEAR(L.tip_mm[n], moved.tip_mm[n] / (2 * h), 1e-8)
              << layout.name << " seed " << seed << ' ' << literal(q);
          EXPECT_NEAR(L.rotation_rad[n], moved.rotation_rad[n] / (2 * h), 1e-11)
              << layout.name << " seed " << seed << ' ' << literal(q);
        }
      }
    }
  }
}

}  // namespace
}  // namespace trueaxis::testing
