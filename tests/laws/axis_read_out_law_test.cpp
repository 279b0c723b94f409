// SPDX-License-Identifier: Apache-2.0
// A read-out of the virtual machine against the way of its own tip.
#include <gtest/gtest.h>

#include "simulate/machine/bodies.hpp"
#include "support/chain_matrices.hpp"
#include "support/shop_machine.hpp"

namespace trueaxis::testing {
namespace {

// σ of 200 readings after the four numbers of a cubic is known to 1/√(2·196) = 5 %; four of these.
TEST(AxisReadOut, AloneStatesItsRmsAndNoise) {
  Draw draw(6);
  const Machine machine = shop_machine("w C' A' Y' b X Z t", draw);
  const double sigma_mm = 1e-3;
  std::normal_distribution<double> normal(0.0, sigma_mm);
  MachineMeasurement data;
  data.source = "x.csv";
  data.kind = MeasurementKind::axis;
  data.axis = AxisName::X;
  for (int i = 0; i < 200; ++i) {
    AxisPositions at{};
    at[0] = -300.0 + 3.0 * i;
    data.axes.push_back(at);
    data.actual.push_back(at[0] + 2e-5 * at[0] + normal(draw.engine));
  }
  const Calibration found = calibrate(machine, std::span(&data, 1));
  ASSERT_EQ(found.read_outs.size(), 1U);
  EXPECT_NEAR(found.read_outs.front().noise, sigma_mm, 0.2 * sigma_mm);
  EXPECT_NEAR(found.noise_mm, sigma_mm, 0.2 * sigma_mm);
  EXPECT_EQ(found.noise_basis, NoiseBasis::residuals);
  EXPECT_NEAR(found.rms_after_mm, found.noise_mm * std::sqrt(196.0 / 200.0), 1e-9);
}

// By the test's own formula, E along the axis' direction: + where the axis carries the tool, or the
// part under tool_minus_workpiece; − where a carriage under the part goes along.
TEST(AxisReadOut, HasTheSignOfTheToolAgainstThePart) {
  for (const ErrorSign sign : {ErrorSign::moving_part, ErrorSign::tool_minus_workpiece})
    for (const AxisName name : {AxisName::X, AxisName::Y, AxisName::A, AxisName::C})
      for (const double sense : {1.0, -1.0}) {
        Draw draw(3);
        Machine machine = shop_machine("w C' A' Y' b X Z t", draw);
        for (MachineAxis& axis : machine.axes)
          if (axis.name == name)
            for (double& one : axis.direction) one *= sense;
        const std::size_t body = index_of(name);
        const double slope = is_rotary(name) ? 1e-4 : 4e-5, at = is_rotary(name) ? 0.7 : 120.0;
        ErrorModel errors;
        errors.sign = sign;
        errors.terms = {{{true, body, body}, PolynomialError{{0.0, slope}, 0.0, 1.0}, 0.0},
                        {{false, body, body}, ConstantError{3e-4}, 0.0}};
        const bool carries_part = name != AxisName::X;
        double expected = sense * slope * at;
        if (carries_part && sign == ErrorSign::moving_part) expected = -expected;
        EXPECT_NEAR(virtual_machine::own_error(machine, errors, name, at), expected + 3e-4, 1e-15)
            << letter_of(name) << ' ' << sense;
      }
}

// The same from the poses of the virtual machine, which knows no read-out: a linear axis takes the
// tip of the tool against the part by its command and that error, along its own direction.
TEST(AxisReadOut, IsTheWayOfTheTip) {
  for (const ErrorSign sign : {ErrorSign::moving_part, ErrorSign::tool_minus_workpiece})
    for (const AxisName name : {AxisName::X, AxisName::Y, AxisName::Z})
      for (const double sense : {1.0, -1.0}) {
        Draw draw(4);
        Machine machine = shop_machine("w C' A' Y' b X Z t", draw);
        Vector3 along{};
        for (MachineAxis& axis : machine.axes) {
          if (axis.name != name) continue;
          for (double& one : axis.direction) one *= sense;
          along = axis.direction;
        }
        const std::size_t body = index_of(name);
        ErrorModel errors;
        errors.sign = sign;
        errors.terms = {{{true, body, body}, PolynomialError{{0.0, 0.01, 0.02}, 0.0, 100.0}, 0.0}};
        AxisPositions q{};
        q[body] = 80.0;
        const Vector3 there = true_tip(machine, errors, q, 120.0),
                      start = true_tip(machine, errors, {}, 120.0);
        double way = 0.0;
        for (std::size_t k = 0; k < 3; ++k) way += along[k] * (there[k] - start[k]);
        // 80 mm of doubles by 4x4 matrices: 1e-12 mm.
        EXPECT_NEAR(way, 80.0 + virtual_machine::own_error(machine, errors, name, 80.0), 1e-12)
            << letter_of(name) << ' ' << sense;
      }
}

}  // namespace
}  // namespace trueaxis::testing
