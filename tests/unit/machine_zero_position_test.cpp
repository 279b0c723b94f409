// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "machine/files/machine_toml.hpp"
#include "machine/zero_position.hpp"
#include "support/chain_matrices.hpp"
#include "support/places.hpp"
#include "support/random_machine.hpp"

namespace trueaxis::testing {
namespace {

/// The tip of a D-H chain, its rows multiplied out, and the direction −z of its last frame.
struct Tool {
  Vector3 tip_mm, direction;
};
Tool multiplied_out(const DenavitHartenbergChain& chain, const AxisPositions& q, bool errors) {
  Matrix4 tool = Tr(chain.part_translation_mm);
  for (const DenavitHartenbergRow& row : chain.rows) {
    DenavitHartenbergRow::Numbers n = row.nominal;
    if (errors) {
      n.theta_rad += row.errors.theta_rad;
      n.d_mm += row.errors.d_mm;
      n.a_mm += row.errors.a_mm;
      n.alpha_rad += row.errors.alpha_rad;
    }
    if (row.axis) (is_rotary(*row.axis) ? n.theta_rad : n.d_mm) += q[index_of(*row.axis)];
    tool = times(tool, exp({0, 0, n.theta_rad}), Tr(n.a_mm, 0, n.d_mm), exp({n.alpha_rad, 0, 0}));
  }
  tool = times(tool, Tr(0, 0, chain.tool_length_mm));
  return {tip_of(tool), turned(tool, {0, 0, -1})};
}

DenavitHartenbergChain drawn(Draw& draw, const Machine& machine, double angle_rad) {
  DenavitHartenbergChain chain;
  chain.part_translation_mm = draw.vector(100);
  chain.tool_length_mm = draw.between(50, 200);
  const auto numbers = [&](double length_mm, double angle) {
    return DenavitHartenbergRow::Numbers{
        draw.between(-angle, angle), draw.between(-length_mm, length_mm),
        draw.between(-length_mm, length_mm), draw.between(-angle, angle)};
  };
  // Lines whose letters they hardly lie across: a table whose turns are a quarter, or nearly.
  const double quarter = two_pi / 4;
  const std::array<std::array<double, 2>, 6> turns{{{-quarter, -quarter},
                                                    {0, quarter},
                                                    {0, -quarter},
                                                    {-quarter, -quarter},
                                                    {quarter, -quarter},
                                                    {-quarter, -quarter}}};
  for (std::size_t i = 0; i < 6; ++i) {
    DenavitHartenbergRow row;
    row.nominal = numbers(100, 0.2);
    row.nominal.theta_rad += turns[i][0];
    row.nominal.alpha_rad += turns[i][1];
    row.errors = numbers(0.05, angle_rad);
    if (i > 0) row.axis = machine.axes[i - 1].name;
    chain.rows.push_back(row);
  }
  return chain;
}

// A chain of numbers with errors is a zero-position machine with location errors: exactly, for
// errors of any size. Lengths of some 1000 mm in twenty multiplications: 1e-11 mm.
TEST(ZeroPositionLaw, OfAChainWithErrors) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Draw draw(seed);
    Machine machine;
    std::vector<ChainTrouble> none;
    machine.axes = parse_chain("w A' C' b X Y Z t", none);
    const DenavitHartenbergChain chain = drawn(draw, machine, seed % 2 == 0 ? 1e-4 : 0.05);
    to_zero_position(chain, machine);
    const MachineModel model(machine, parameter_errors(chain, machine));
    for (int i = 0; i < 5; ++i) {
      const AxisPositions q = draw.positions(machine);
      const Setting setting = first_setting(machine);
      const Tool nominal = multiplied_out(chain, q, false), actual = multiplied_out(chain, q, true);
      EXPECT_LT(distance(model.nominal(q, setting).tip_mm, nominal.tip_mm), 1e-11) << seed;
      EXPECT_LT(distance(model.nominal(q, setting).direction, nominal.direction), 1e-13) << seed;
      EXPECT_LT(distance(model.actual(q, setting).tip_mm, actual.tip_mm), 1e-11) << seed;
      EXPECT_LT(distance(model.actual(q, setting).direction, actual.direction), 1e-13) << seed;
    }
  }
}

// The example file by the products of the paper's Table 1 written out, x, y and z row of its Eq. 8
// with the y row as it must be.
TEST(ZeroPosition, OfTheExampleByItsEquation) {
  const Machine machine =
      read_machine_toml(places::source() + "/data/five_axis/vmc50_dh.toml").machine;
  const double dm = 35, am = 20, d1 = -15, a1 = 40, d2 = 60, a2 = 25, a3 = 80, a4 = 30, a5 = 45,
               L = 110;
  const Vector3 t{12, -8, 20};
  Draw draw(1);
  for (int i = 0; i < 20; ++i) {
    const AxisPositions q = draw.positions(machine);
    const auto [X, Y, Z, A, B, C] = q;
    const double C1 = std::cos(A), S1 = std::sin(A), C2 = std::cos(C), S2 = std::sin(C);
    const Vector3 tip{-L * C2 + (a2 + a5 + Y) * S2 + (X - a4) * C2 + d1 + t[0],
                      -L * C1 * S2 + X * C1 * S2 - (Y + a2 + a5) * C1 * C2 - (d2 + a3 - Z) * S1 -
                          (a1 + a4 * S2) * C1 - am + t[1],
                      -L * S1 * S2 + (-a2 - Y - a5) * S1 * C2 + (d2 + a3 - Z) * C1 +
                          (-a1 + X * S2 - a4 * S2) * S1 + dm + t[2]};
    const ToolPose pose = MachineModel(machine).nominal(q, first_setting(machine));
    EXPECT_LT(distance(pose.tip_mm, tip), 1e-11) << literal(q);
    EXPECT_LT(distance(pose.direction, {C2, C1 * S2, S1 * S2}), 1e-13) << literal(q);
  }
}

}  // namespace
}  // namespace trueaxis::testing
