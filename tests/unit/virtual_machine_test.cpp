// SPDX-License-Identifier: Apache-2.0
// The virtual machine against the machine that is fitted: they share no formula, so that each is
// the other's test. Both are exact to rounding: 1e-11 mm is 50 times the rounding of 1000 mm.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulate/machine/measure.hpp"

namespace trueaxis {
namespace {

using virtual_machine::MeasurementKind;
using virtual_machine::MeasurementPlan;

Machine machine_of(const std::string& chain, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-200.0, 200.0);
  std::vector<ChainTrouble> troubles;
  Machine machine;
  machine.name = chain;
  machine.chain = chain;
  machine.axes = parse_chain(chain, troubles);
  for (MachineAxis& axis : machine.axes)
    axis.point_mm = {place(random), place(random), place(random)};
  machine.tool = {{place(random), place(random), 300.0}, {0.0, 0.0, 1.0}, 120.0};
  return machine;
}

/// Every component and location error of the chain, up to 0.1 mm and 0.5 mrad.
ErrorModel errors_of(const Machine& machine, ErrorSign sign, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  ErrorModel errors;
  errors.sign = sign;
  errors.reference_mm = {{{10.0, -20.0, 30.0}, {5.0, 6.0, -7.0}, {0.0, 40.0, 100.0}}};
  const auto size = [&](std::size_t direction) {
    return (direction < 3 ? 0.1 : 5e-4) * unit(random);
  };
  for (const MachineAxis& axis : machine.axes) {
    for (std::size_t direction = 0; direction < 6; ++direction) {
      const ErrorName component{true, direction, index_of(axis.name)};
      const double scale = is_rotary(axis.name) ? 1.0 : 200.0;
      switch (random() % 4) {
        case 0:
          errors.terms.push_back({component, ConstantError{size(direction)}});
          break;
        case 1:
          errors.terms.push_back(
              {component,
               PolynomialError{{size(direction), size(direction), size(direction)}, 3.0, scale}});
          break;
        case 2:
          errors.terms.push_back({component, FourierError{{{1.0, size(direction), size(direction)},
                                                           {3.0, size(direction), 0.0}},
                                                          is_rotary(axis.name) ? two_pi : 50.0}});
          break;
        default:
          errors.terms.push_back(
              {component,
               TableError{{-scale, -0.1 * scale, 0.4 * scale, 1.1 * scale},
                          {size(direction), size(direction), size(direction), size(direction)},
                          random() % 2 == 0}});
      }
      const ErrorName location{false, direction, index_of(axis.name)};
      if (!without_effect(location))
        errors.terms.push_back({location, ConstantError{size(direction)}});
    }
  }
  for (std::size_t direction = 0; direction < 6; ++direction)
    errors.terms.push_back({{false, direction, spindle_body}, ConstantError{size(direction)}});
  return errors;
}

AxisPositions anywhere(std::mt19937_64& random) {
  std::uniform_real_distribution<double> along(-250.0, 250.0), about(-2.0, 2.0);
  return {along(random), along(random), along(random), about(random), about(random), about(random)};
}

constexpr const char* chains[] = {"w C' A' Y' b X Z t", "w C' B' b X Y Z t", "w Z' X' A' C' Y' b t",
                                  "w b X Y Z C A t",    "w C' b X Y Z B t",  "w X' Y' b Z t"};

TEST(VirtualMachine, StandsWhereTheModelSays) {
  constexpr std::uint64_t seed = 20261123;
  std::mt19937_64 random(seed);
  for (int number = 0; number < 240; ++number) {
    const Machine machine = machine_of(chains[number % std::size(chains)], random);
    const ErrorModel errors = errors_of(
        machine, number % 2 ? ErrorSign::moving_part : ErrorSign::tool_minus_workpiece, random);
    const MachineModel model(machine, errors);
    const AxisPositions axes = anywhere(random);
    const Setting setting{{}, 80.0};
    const Vector3 modelled = model.actual(axes, setting).tip_mm;
    const virtual_machine::Ends ends = virtual_machine::ends(machine, errors, axes);
    // The point of the part at which the model has the tip is where the tip is.
    const Vector3 there = virtual_machine::transformed(ends.bed_from_table, modelled);
    const Vector3 tip = virtual_machine::tip_mm(machine, ends, 80.0);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(there[i], tip[i], 1e-11)
          << machine.chain << ", seed " << seed << ", number " << number;
  }
}

MeasurementPlan ball_plan() {
  MeasurementPlan plan;
  plan.tool_length_mm = 120.0;
  plan.balls_mm = {{60.0, 20.0, 30.0}, {-40.0, 50.0, 30.0}};
  for (const double a : {-0.6, 0.0, 0.6})
    for (const double c : {0.0, 1.5, 3.0, 4.5})
      plan.positions.push_back({0.0, 0.0, 0.0, a, 0.0, c});
  return plan;
}

TEST(VirtualMachine, WithoutErrorsTheTipIsAtTheBall) {
  std::mt19937_64 random(1);
  const Machine machine = machine_of(chains[0], random);
  for (const auto& row : virtual_machine::measure(machine, {}, ball_plan()))
    for (const double d : row.deviation_mm) EXPECT_NEAR(d, 0.0, 1e-11);
}

TEST(VirtualMachine, ACentredBallIsReadWhereTheDeviationIsNone) {
  std::mt19937_64 random(2);
  const Machine machine = machine_of(chains[0], random);
  const ErrorModel errors = errors_of(machine, ErrorSign::moving_part, random);
  MeasurementPlan plan = ball_plan();
  plan.centred = true;
  const MachineModel model(machine, errors);
  for (const auto& row : virtual_machine::measure(machine, errors, plan)) {
    const Vector3 tip = model.actual(row.axes, {{}, 120.0}).tip_mm;
    const Vector3& ball = plan.balls_mm[static_cast<std::size_t>(row.ball - 1)];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(tip[i], ball[i], 1e-11);
  }
}

TEST(VirtualMachine, ReversalDriftAndSlipAreWhatWasAsked) {
  std::mt19937_64 random(3);
  const Machine machine = machine_of("w b X Y Z t", random);
  MeasurementPlan plan;
  plan.balls_mm = {{0.0, 0.0, 0.0}};
  plan.tool_length_mm = 120.0;
  plan.positions.assign(6, {});
  plan.disturbance.drift_mm_per_s = {0.0, 1e-4, 0.0};
  plan.disturbance.slip_mm = {0.0, 0.0, 0.02};
  plan.disturbance.slip_after = 4;
  const auto rows = virtual_machine::measure(machine, {}, plan);
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].deviation_mm[1], 1e-3 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(rows[i].deviation_mm[2], i < 4 ? 0.0 : 0.02, 1e-12);
  }
  MeasurementPlan read;
  read.kind = MeasurementKind::axis;
  read.axis = AxisName::Y;
  for (const double y : {0.0, 10.0, 20.0, 10.0, 0.0}) read.positions.push_back({0.0, y});
  read.disturbance.reversal[1] = 0.006;
  const auto travelled = virtual_machine::measure(machine, {}, read);
  for (std::size_t i = 0; i < travelled.size(); ++i)
    EXPECT_NEAR(travelled[i].actual - travelled[i].axes[1], i < 3 ? 0.0 : 0.006, 1e-12);
}

}  // namespace
}  // namespace trueaxis
