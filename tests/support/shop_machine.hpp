// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "simulate/machine/measure.hpp"
#include "support/random_machine.hpp"
#include "trueaxis/calibration.hpp"

/// Machines with errors as a shop has them, measured by the virtual machine, which shares no
/// formula with the model.
namespace trueaxis::testing {

inline Machine shop_machine(const char* chain, Draw& draw) {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.name = "shop";
  machine.chain = chain;
  machine.axes = parse_chain(chain, none);
  for (MachineAxis& axis : machine.axes) {
    if (is_rotary(axis.name))
      axis.point_mm = draw.vector(40.0);
    else
      axis.low = -350.0, axis.high = 350.0;
  }
  machine.tool.gauge_point_mm = {0.0, 0.0, 150.0};
  machine.tool.length_mm = 120.0;
  return machine;
}

/// Location errors of 20 µm and 50 µrad, all but those that are `held`; of every axis six component
/// errors of 1 to 6 µm and 5 to 30 µrad RMS times `size`, each as likely as any other on a
/// logarithmic scale: of a rotary axis orders 1 to 4 with amplitudes from nothing to the largest,
/// of a linear one cubics without a straightness that would be squareness. With a `spread` sizes
/// are log-normal, as far apart as this factor, and so are amplitudes normal about them.
inline ErrorModel shop_errors(const Machine& machine, double size,
                              const std::vector<std::string>& held, Draw& draw,
                              double spread = 0.0) {
  ErrorModel errors;
  std::normal_distribution<double> normal;
  const auto locate = [&](std::size_t body, std::size_t directions) {
    for (std::size_t d = 0; d < directions; ++d) {
      const ErrorName name{false, d, body};
      if (without_effect(name) || std::ranges::find(held, to_string(name)) != held.end()) continue;
      errors.terms.push_back(
          {name, ConstantError{normal(draw.engine) * (name.angular() ? 50e-6 : 0.02)}, 0.0});
    }
  };
  for (const MachineAxis& axis : machine.axes) locate(index_of(axis.name), 6);
  locate(spindle_body, 5);
  if (size == 0.0) return errors;
  for (const MachineAxis& axis : machine.axes)
    for (std::size_t d = 0; d < 6; ++d) {
      const ErrorName name{true, d, index_of(axis.name)};
      const double rms = size * (d < 3 ? 1e-3 : 5e-6) *
                         (spread > 0.0 ? 2.4 * std::pow(spread, normal(draw.engine))
                                       : std::pow(6.0, draw.between(0.0, 1.0)));
      if (is_rotary(axis.name)) {
        FourierError fourier;
        double square = 0.0;
        for (int n = 1; n <= 4; ++n) {
          const double a = spread > 0.0 ? std::hypot(normal(draw.engine), normal(draw.engine)) / n
                                        : draw.between(0.0, 1.0),
                       phase = draw.between(0.0, two_pi);
          fourier.terms.push_back(
              {static_cast<double>(n), a * std::cos(phase), a * std::sin(phase)});
          square += spread > 0.0 ? 1.0 / (n * n) : 0.5 * a * a;
        }
        for (auto& term : fourier.terms)
          term.cos *= rms / std::sqrt(square), term.sin *= rms / std::sqrt(square);
        errors.terms.push_back({name, fourier, 0.0});
      } else {
        // P1, P2 = (3s² − 1)/2 and P3 = (5s³ − 3s)/2, of mean squares 1/3, 1/5, 1/7.
        const bool across = d < 3 && d != name.body;
        const double p1 = across ? 0.0 : normal(draw.engine), p2 = 0.5 * normal(draw.engine),
                     p3 = 0.3 * normal(draw.engine);
        const double square = spread > 0.0 ? (across ? 0.0 : 1.0 / 3.0) + 0.25 / 5.0 + 0.09 / 7.0
                                           : p1 * p1 / 3.0 + p2 * p2 / 5.0 + p3 * p3 / 7.0;
        const double f = rms / std::sqrt(square);
        errors.terms.push_back(
            {name,
             PolynomialError{
                 {-0.5 * p2 * f, (p1 - 1.5 * p3) * f, 1.5 * p2 * f, 2.5 * p3 * f}, 0.0, 350.0},
             0.0});
      }
    }
  return errors;
}

/// Two balls at five tilts by every 30°, read by ball or by a bar in four directions.
inline virtual_machine::MeasurementPlan shop_plan(const Machine& machine, bool bar, double noise_mm,
                                                  Draw& draw) {
  virtual_machine::MeasurementPlan plan;
  plan.kind = bar ? virtual_machine::MeasurementKind::bar : virtual_machine::MeasurementKind::ball;
  plan.noise_mm = noise_mm;
  plan.seed = static_cast<std::uint64_t>(draw.whole(1, 1 << 30));
  plan.tool_length_mm = 120.0;
  for (const Vector3 near : {Vector3{100.0, 20.0, 40.0}, Vector3{-60.0, 80.0, 90.0}}) {
    const Vector3 off = draw.vector(20.0);
    plan.balls_mm.push_back({near[0] + off[0], near[1] + off[1], near[2] + off[2]});
  }
  std::size_t tilt = 0;
  for (const MachineAxis& axis : machine.axes)
    if (is_rotary(axis.name) && axis.name != AxisName::C) tilt = index_of(axis.name);
  for (const double t : {-80.0, -50.0, -20.0, 10.0, 30.0})
    for (int k = 0; k < 12; ++k) {
      AxisPositions at{};
      at[tilt] = t * rad_per_deg;
      at[index_of(AxisName::C)] = 30.0 * k * rad_per_deg;
      plan.positions.push_back(at);
    }
  if (bar)
    plan.bar_mm = {{0.0, 0.0, 100.0}, {70.0, 0.0, 70.0}, {0.0, 70.0, 70.0}, {-70.0, 0.0, 70.0}};
  return plan;
}

inline MachineMeasurement measured(const Machine& machine, const ErrorModel& errors,
                                   const virtual_machine::MeasurementPlan& plan) {
  MachineMeasurement out;
  out.source = "shop.csv";
  const bool bar = plan.kind == virtual_machine::MeasurementKind::bar;
  out.kind = bar ? MeasurementKind::bar : MeasurementKind::ball;
  if (plan.noise_mm > 0.0) out.noise_mm = plan.noise_mm;
  for (const auto& row : virtual_machine::measure(machine, errors, plan)) {
    out.setup.push_back(row.setup);
    out.ball.push_back(row.ball);
    out.axes.push_back(row.axes);
    if (bar)
      out.length_mm.push_back(row.length_mm);
    else
      out.deviation_mm.push_back(row.deviation_mm);
    out.tool_length_mm.push_back(plan.tool_length_mm);
    out.time_s.push_back(row.time_s);
  }
  return out;
}

/// The tip in M's zero position, that is in the part, of the virtual machine.
inline Vector3 true_tip(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
                        double tool_length_mm) {
  using namespace virtual_machine;
  const Ends at = ends(machine, errors, axes);
  const Vector3 tip = tip_mm(machine, at, tool_length_mm);
  const Homogeneous& G = at.bed_from_table;
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += G[j][i] * (tip[j] - G[j][3]);
  return out;
}

}  // namespace trueaxis::testing
