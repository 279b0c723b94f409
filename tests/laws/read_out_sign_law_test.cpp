// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/shop_machine.hpp"

namespace trueaxis::testing {
namespace {

/// A read-out between tool and part of an axis of the virtual machine, without noise: how far the
/// tip has come along the axis' own direction, or turned about it.
MachineMeasurement read_out(const Machine& machine, const ErrorModel& errors, AxisName name) {
  const MachineAxis& axis = *machine.find(name);
  MachineMeasurement out;
  out.source = "axis.csv";
  out.kind = MeasurementKind::axis;
  out.axis = name;
  const Vector3 start = true_tip(machine, errors, {}, 120.0);
  for (int i = -10; i <= 10; ++i) {
    AxisPositions at{};
    at[index_of(name)] = 30.0 * i;
    const Vector3 tip = true_tip(machine, errors, at, 120.0);
    double come = 0.0;
    for (std::size_t k = 0; k < 3; ++k) come += axis.direction[k] * (tip[k] - start[k]);
    out.axes.push_back(at);
    out.actual.push_back(come);
  }
  return out;
}

// An axis of the workpiece and one of the tool, either sense, under either sign: the machine with
// the errors found puts the tip where the virtual machine does. With the wrong sign it would be
// twice the error off, 36 µm. The polynomial of degree 3 is the error itself, so that rounding is
// left; the zero of a read-out is not known, and is subtracted.
TEST(ReadOutSign, OfTheWorkpieceSideToo) {
  for (const ErrorSign sign : {ErrorSign::moving_part, ErrorSign::tool_minus_workpiece})
    for (const AxisName name : {AxisName::X, AxisName::Y})
      for (const double sense : {1.0, -1.0}) {
        Draw draw(1);
        Machine machine = shop_machine("w C' A' Y' b X Z t", draw);
        for (MachineAxis& axis : machine.axes)
          if (axis.name == name)
            for (double& one : axis.direction) one *= sense;
        ErrorModel truth;
        truth.sign = sign;
        const std::size_t body = index_of(name);
        truth.terms = {
            {{true, body, body}, PolynomialError{{0.0, 0.018, -0.007}, 0.0, 300.0}, 0.0}};
        const MachineMeasurement data = read_out(machine, truth, name);
        CalibrationOptions options;
        options.errors.sign = sign;
        const Calibration found = calibrate(machine, std::span(&data, 1), options);
        const MachineModel model(machine, found.errors);
        Setting setting;
        setting.tool_length_mm = 120.0;
        const auto off = [&](double position) {
          AxisPositions at{};
          at[body] = position;
          return model.actual(at, setting).tip_mm[body] - true_tip(machine, truth, at, 120.0)[body];
        };
        for (const double position : {-300.0, -120.0, 45.0, 300.0})
          EXPECT_NEAR(off(position) - off(0.0), 0.0, 1e-9)
              << letter_of(name) << ' ' << sense << ' ' << position;
      }
}

}  // namespace
}  // namespace trueaxis::testing
