// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"
#include "trueaxis/calibration.hpp"

/// Measurements on a machine whose errors are known, made by the test's own 4×4 matrices.
namespace trueaxis::testing {

/// A trunnion table under X Y Z, the axes A and C 25 and 40 mm off the zero point.
inline Machine trunnion() {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.chain = "w C' A' Y' b X Z t";
  machine.axes = parse_chain(machine.chain, none);
  for (MachineAxis& axis : machine.axes) {
    if (axis.name == AxisName::A) axis.point_mm = {0.0, 15.0, -40.0};
    if (axis.name == AxisName::C) axis.point_mm = {5.0, -10.0, 0.0};
  }
  machine.tool.gauge_point_mm = {0.0, 0.0, 150.0};
  machine.tool.length_mm = 120.0;
  return machine;
}

/// A head B over a table C: one ball and one tool leave more open on it than on a trunnion.
inline Machine head_and_table() {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.chain = "w C' Y' b X Z B t";
  machine.axes = parse_chain(machine.chain, none);
  for (MachineAxis& axis : machine.axes)
    if (axis.name == AxisName::B) axis.point_mm = {0.0, 0.0, 350.0};
  machine.tool.gauge_point_mm = {0.0, 0.0, 250.0};
  machine.tool.length_mm = 120.0;
  return machine;
}

/// Location errors of the size that machines have: 20 µm, 50 µrad.
inline ErrorModel drawn_location_errors(const Machine& machine, Draw& draw) {
  ErrorModel errors;
  std::vector<std::size_t> bodies{spindle_body};
  for (const MachineAxis& axis : machine.axes) bodies.push_back(index_of(axis.name));
  std::normal_distribution<double> normal;
  for (const std::size_t body : bodies)
    for (std::size_t direction = 0; direction < (body == spindle_body ? 5 : 6); ++direction) {
      const ErrorName name{false, direction, body};
      if (without_effect(name)) continue;
      errors.terms.push_back(
          {name, ConstantError{normal(draw.engine) * (name.angular() ? 50e-6 : 0.02)}});
    }
  return errors;
}

struct BallBench {
  const Machine& machine;
  const ErrorModel& errors;

  Matrix4 workpiece(const AxisPositions& q) const { return side(q, true); }
  /// The tip in M.
  Vector3 tip(const AxisPositions& q, double tool_length_mm) const {
    const ChainMatrices m{machine, errors};
    const Vector3& g = machine.tool.gauge_point_mm;
    const Matrix4 S = times(Tr(g), Tr(m.three(false, false, spindle_body, 0.0)),
                            exp(m.three(false, true, spindle_body, 0.0)), Tr(g, -1.0));
    return tip_of(times(side(q, false), S, Tr(g), Tr(machine.tool.direction, -tool_length_mm)));
  }
  Vector3 deviation(const AxisPositions& q, const Vector3& ball, double tool_length_mm) const {
    const Vector3 at = tip_of(times(workpiece(q), Tr(ball))), t = tip(q, tool_length_mm);
    return {at[0] - t[0], at[1] - t[1], at[2] - t[2]};
  }
  /// The linear axes that put the tip on the ball: the deviation is linear in them.
  void follow(AxisPositions& q, const Vector3& ball, double tool_length_mm) const {
    for (int twice = 0; twice < 2; ++twice) {
      const Vector3 d = deviation(q, ball, tool_length_mm);
      double a[3][4];
      for (std::size_t j = 0; j < 3; ++j) {
        AxisPositions moved = q;
        moved[j] += 1.0;
        const Vector3 e = deviation(moved, ball, tool_length_mm);
        for (std::size_t i = 0; i < 3; ++i) a[i][j] = d[i] - e[i];
        a[j][3] = d[j];
      }
      for (std::size_t c = 0; c < 3; ++c) {  // Gauss-Jordan with the largest pivot
        std::size_t p = c;
        for (std::size_t r = c; r < 3; ++r)
          if (std::fabs(a[r][c]) > std::fabs(a[p][c])) p = r;
        std::swap(a[c], a[p]);
        for (std::size_t r = 0; r < 3; ++r) {
          const double f = r == c ? 0.0 : a[r][c] / a[c][c];
          for (std::size_t k = 0; k < 4; ++k) a[r][k] -= f * a[c][k];
        }
      }
      for (std::size_t j = 0; j < 3; ++j) q[j] += a[j][3] / a[j][j];
    }
  }

 private:
  Matrix4 side(const AxisPositions& q, bool of_workpiece) const {
    const ChainMatrices m{machine, errors};
    Matrix4 out = unit_matrix();
    for (const MachineAxis& axis : machine.axes) {
      if (axis.carries_workpiece != of_workpiece) continue;
      const Matrix4 a = m.A(axis, q[index_of(axis.name)]);
      out = of_workpiece ? times(a, out) : times(out, a);
    }
    return out;
  }
};

/// What a plan has: rotary positions, balls and tool lengths.
struct BallPlan {
  std::vector<double> a_deg{-90, -60, -30, 0, 30}, c_deg{0, 45, 90, 135, 180, 225, 270, 315};
  std::vector<Vector3> balls{{120.0, 20.0, 40.0}, {-60.0, 90.0, 90.0}};
  std::vector<double> tool_lengths_mm{120.0, 190.0};
  std::size_t tilt = 3;  ///< the axis of a_deg
  double off_mm = 0.3;   ///< linear axes this far off the ball, drawn; 0 follows it
};

/// Deviations at every position of a plan, with white noise.
inline MachineMeasurement measure_balls(const BallBench& bench, const BallPlan& plan,
                                        double sigma_mm, Draw& draw) {
  MachineMeasurement out;
  out.source = "ball.csv";
  out.kind = MeasurementKind::ball;
  out.noise_mm = sigma_mm;
  std::normal_distribution<double> normal(0.0, sigma_mm > 0.0 ? sigma_mm : 1.0);
  const ErrorModel none;
  const BallBench nominal{bench.machine, none};
  for (std::size_t b = 0; b < plan.balls.size(); ++b)
    for (const double length : plan.tool_lengths_mm)
      for (const double a : plan.a_deg)
        for (const double c : plan.c_deg) {
          AxisPositions q{};
          q[plan.tilt] = a * rad_per_deg, q[5] = c * rad_per_deg;
          nominal.follow(q, plan.balls[b], length);
          for (std::size_t i = 0; i < 3; ++i) q[i] += draw.between(-plan.off_mm, plan.off_mm);
          Vector3 d = bench.deviation(q, plan.balls[b], length);
          if (sigma_mm > 0.0)
            for (double& one : d) one += normal(draw.engine);
          out.setup.push_back(1);
          out.ball.push_back(static_cast<int>(b) + 1);
          out.axes.push_back(q);
          out.deviation_mm.push_back(d);
          out.tool_length_mm.push_back(length);
        }
  return out;
}

}  // namespace trueaxis::testing
