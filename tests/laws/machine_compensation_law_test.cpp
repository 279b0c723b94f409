// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"

namespace trueaxis::testing {
namespace {

/// A machine drawn with errors of a machine's size, 20 µm and 50 µrad.
struct Bench {
  Bench(const Layout& layout, std::uint64_t seed, double size = 1.0)
      : draw(seed), machine(draw.machine(layout)) {
    machine.max_rotary_change_rad = 10.0 * rad_per_deg;  // what is drawn is seldom nearer to a pole
    errors = draw.errors(machine, size * 0.02, size * 5e-5);
    setting = first_setting(machine);
    said = std::string(layout.name) + " seed " + std::to_string(seed) + ' ';
  }
  /// By the matrices.
  Matrix4 actual(const AxisPositions& q) const {
    return ChainMatrices{machine, errors}.tool_in_part(q, setting);
  }
  Vector3 direction(const Matrix4& tool) const { return turned(tool, machine.tool.direction); }
  Matrix4 nominal(const AxisPositions& q) const {
    const ErrorModel none;
    return ChainMatrices{machine, none}.tool_in_part(q, setting);
  }

  Draw draw;
  Machine machine;
  ErrorModel errors;
  Setting setting;
  std::string said;
};

// The tip to 1e-9 mm and the direction to 1e-9 rad, as the matrices have them; a table or Fourier
// sum that turns sharply makes no difference, since Newton's method meets the errors where it goes.
TEST(MachineCompensationLaw, ExactMeetsTipAndDirection) {
  int poles = 0, all = 0;
  for (const Layout& layout : layouts()) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Bench bench(layout, seed);
      const MachineModel model(bench.machine, bench.errors);
      const AxisPositions q = bench.draw.positions(bench.machine);
      const CompensatedPosition result = compensate_exactly(model, q, bench.setting);
      const std::string said = bench.said + literal(q);
      ++all;
      if (result.status == CompensationStatus::singular) {
        ++poles;
        continue;
      }
      ASSERT_EQ(result.status, CompensationStatus::compensated) << said << result.why;
      const Matrix4 tool = bench.actual(result.axes), wanted = bench.nominal(q);
      EXPECT_LT(distance(tip_of(tool), tip_of(wanted)), 1e-9) << said;
      EXPECT_LT(result.tip_left_mm, 1e-9) << said;
      const double angle = angle_between_rad(bench.direction(tool), bench.direction(wanted));
      EXPECT_NEAR(result.direction_left_rad, angle, 1e-12) << said;
      if (bench.machine.rotary_count() >= 2 && bench.machine.linear_count() == 3) {
        EXPECT_LT(angle, 1e-9) << said;
      }
    }
  }
  EXPECT_LT(poles, all / 50);
}

// One rotary axis: no position of it near the result makes the angle less. The linear axes, whose
// angular errors turn the tool a little, follow by the change of the tip.
TEST(MachineCompensationLaw, WithOneRotaryAxisTheAngleIsLeast) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Bench bench(layouts()[8], seed);
    const MachineModel model(bench.machine, bench.errors);
    const AxisPositions q = bench.draw.positions(bench.machine);
    const CompensatedPosition result = compensate_exactly(model, q, bench.setting);
    const Vector3 wanted = bench.direction(bench.nominal(q));
    for (const double by : {-1e-5, -1e-6, 1e-6, 1e-5}) {
      AxisPositions other = result.axes;
      other[index_of(AxisName::A)] += by;
      const double angle = angle_between_rad(bench.direction(bench.actual(other)), wanted);
      EXPECT_GT(angle, result.direction_left_rad) << bench.said << literal(q) << by;
    }
  }
}

/// The least angle that A alone leaves, by thirds.
double least_angle_by_a(const Bench& bench, const AxisPositions& q) {
  const Vector3 wanted = bench.direction(bench.nominal(q));
  const auto at = [&](double a) {
    AxisPositions axes = q;
    axes[index_of(AxisName::A)] += a;
    return angle_between_rad(bench.direction(bench.actual(axes)), wanted);
  };
  double low = -bench.machine.max_rotary_change_rad, high = -low;  // of A: one valley
  for (int n = 0; n < 60; ++n) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return at(0.5 * (low + high));
}

// Near a pole the rotary axes turn by no more than twenty times the angle that they correct, and
// leave no more of it than A alone would.
TEST(MachineCompensationLaw, NearAPoleTheTipIsExactAndTheChangeIsBoundedByItsGain) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Bench bench(layouts()[0], seed);
    bench.machine.max_rotary_change_rad = 0.5 * rad_per_deg;
    // Angles of the linear axes are constants, so that the scan need not move these; no corners.
    for (ErrorTerm& term : bench.errors.terms)
      if (term.name.body < 3 || std::holds_alternative<TableError>(term.function))
        term.function = ConstantError{bench.draw.between(-5e-5, 5e-5)};
    for (ErrorTerm& term : bench.errors.terms)
      if (without_effect(term.name)) term.function = ConstantError{0.0};
    for (const double tilt : {0.0, 1e-5, 1e-3, -2e-4, 0.02, -0.04}) {
      AxisPositions q = bench.draw.positions(bench.machine);
      q[index_of(AxisName::A)] = tilt;
      const MachineModel model(bench.machine, bench.errors);
      const CompensatedPosition result = compensate_exactly(model, q, bench.setting);
      const std::string said = bench.said + literal(q);
      EXPECT_LT(distance(tip_of(bench.actual(result.axes)), tip_of(bench.nominal(q))), 1e-9)
          << said;
      const double angle =
          angle_between_rad(bench.direction(bench.actual(q)), bench.direction(bench.nominal(q)));
      // Errors turn the Jacobian by some 1e-4, and those of the linear axes go along.
      double square = 0.0;
      for (const AxisName axis : {AxisName::A, AxisName::C})
        square += std::pow(result.axes[index_of(axis)] - q[index_of(axis)], 2);
      EXPECT_LE(std::sqrt(square), 20.0 * 1.02 * angle) << said;
      EXPECT_LT(result.direction_left_rad, 1.001 * least_angle_by_a(bench, q) + 1e-9) << said;
      if (result.direction_left_rad > 1e-9) {
        EXPECT_EQ(result.status, CompensationStatus::singular) << said;
      }
    }
  }
}

TEST(MachineCompensationLaw, WithoutErrorsNothingMoves) {
  for (const Layout& layout : layouts()) {
    Draw draw(3);
    const Machine machine = draw.machine(layout);
    const MachineModel model(machine);
    const AxisPositions q = draw.positions(machine);
    const Setting setting = first_setting(machine);
    EXPECT_EQ(compensate_exactly(model, q, setting).axes, q) << layout.name;
    EXPECT_EQ(compensate_by_differential(model, q, setting).axes, q) << layout.name;
  }
}

// Δq is linear in all errors; its difference from the exact change is of second order, so that
// errors of half the size leave a quarter (an eighth of the rest: 5 % at 50 µrad).
TEST(MachineCompensationLaw, DifferentialIsProportionalAndAQuarterIsLeft) {
  std::size_t compensated = 0, of_second_order = 0;
  for (const Layout& layout : layouts()) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      AxisPositions full{}, half{};
      double left[2] = {}, size = 0.0;
      for (const double factor : {1.0, 0.5}) {
        Bench bench(layout, seed, factor);
        const MachineModel model(bench.machine, bench.errors);
        const AxisPositions q = bench.draw.positions(bench.machine);
        const CompensatedPosition result = compensate_by_differential(model, q, bench.setting);
        if (result.status != CompensationStatus::compensated) break;
        for (std::size_t k = 0; k < axis_count; ++k)
          (factor == 1.0 ? full : half)[k] = result.axes[k] - q[k];
        const Matrix4 tool = bench.actual(result.axes);
        left[factor == 1.0 ? 0 : 1] = distance(tip_of(tool), tip_of(bench.nominal(q)));
        size = std::max(size, distance(tip_of(bench.actual(q)), tip_of(bench.nominal(q))));
      }
      for (std::size_t k = 0; k < axis_count; ++k)
        EXPECT_NEAR(half[k], 0.5 * full[k], 3e-13) << layout.name << " seed " << seed;
      compensated += full != AxisPositions{} && half != AxisPositions{};
      // If the second order is above rounding and the change is not a part of a turn.
      const double turn = std::max({std::fabs(full[3]), std::fabs(full[4]), std::fabs(full[5])});
      if (left[0] > 1e-8 && turn < 1e-3) {
        EXPECT_NEAR(left[1] / left[0], 0.25, 0.05) << layout.name << " seed " << seed;
        EXPECT_LT(left[0], 0.05 * size) << layout.name << " seed " << seed;
        ++of_second_order;
      }
    }
  }
  EXPECT_GE(compensated, 5 * layouts().size());  // of ten draws each, without the pole
  EXPECT_GE(of_second_order, layouts().size());
}

// Six axes: of all rotary positions with this direction the result has the least rotary change. The
// way along which the direction stays is the null space of the three rotary screws across it, by
// the nominal Jacobian; the change has next to nothing along it (errors turn it by 1e-4).
TEST(MachineCompensationLaw, OfSixAxesTheLeastRotaryChange) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Bench bench(layouts().back(), seed);
    const MachineModel model(bench.machine, bench.errors);
    const AxisPositions q = bench.draw.positions(bench.machine);
    const CompensatedPosition result = compensate_exactly(model, q, bench.setting);
    if (result.status != CompensationStatus::compensated) continue;
    const ToolJacobian J = model.jacobian(q, bench.setting);
    const Vector3 d = model.nominal(q, bench.setting).direction;
    // The w with Σ wᵢ (ωᵢ × d) = 0: wᵢ = (ωⱼ × d) × (ωₖ × d) · d, since all lie across d.
    const auto across = [&](std::size_t i) {
      const Vector3& w = J[i].rotation_rad;
      return Vector3{w[1] * d[2] - w[2] * d[1], w[2] * d[0] - w[0] * d[2],
                     w[0] * d[1] - w[1] * d[0]};
    };
    const auto triple = [&](const Vector3& a, const Vector3& b) {
      return (a[1] * b[2] - a[2] * b[1]) * d[0] + (a[2] * b[0] - a[0] * b[2]) * d[1] +
             (a[0] * b[1] - a[1] * b[0]) * d[2];
    };
    const Vector3 free{triple(across(4), across(5)), triple(across(5), across(3)),
                       triple(across(3), across(4))};
    const double length = std::hypot(free[0], free[1], free[2]);
    if (length < 0.1) continue;
    double along = 0.0, size = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double change = result.axes[3 + i] - q[3 + i];
      along += change * free[i] / length;
      size += change * change;
    }
    EXPECT_LT(std::fabs(along), 0.01 * std::sqrt(size)) << bench.said << literal(q);
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

TEST(MachineCompensationLaw, SaysWhichAxisLeavesItsLimits) {
  Bench bench(layouts()[0], 1);
  AxisPositions q = bench.draw.positions(bench.machine);
  for (MachineAxis& axis : bench.machine.axes)
    if (axis.name == AxisName::X) axis.low = q[0] - 1e-7, axis.high = q[0] + 1e-7;
  const CompensatedPosition result =
      compensate_exactly(MachineModel(bench.machine, bench.errors), q, bench.setting);
  EXPECT_EQ(result.status, CompensationStatus::outside);
  EXPECT_EQ(result.why.substr(0, 4), "X at");
}

}  // namespace
}  // namespace trueaxis::testing
