// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/unknown.hpp"

#include <algorithm>
#include <cmath>

#include "blind_machine/catalogue.hpp"

namespace trueaxis::blind_machine {
namespace {

using Engine = std::mt19937_64;

double drawn(Engine& engine, double low, double high) {
  return low + (high - low) * std::uniform_real_distribution<>(0.0, 1.0)(engine);
}
std::size_t one_of(Engine& engine, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine);
}

/// A component error of an axis that is not absorbed in second order only.
ErrorName drawn_error(const Machine& machine, bool rotary, Engine& engine) {
  for (;;) {
    const AxisName axis = machine.axes[one_of(engine, machine.axes.size())].name;
    if (!rotary || is_rotary(axis)) return {true, one_of(engine, 6), index_of(axis)};
  }
}

// 50 to 110° wide at its foot: a raised cosine, a triangle or a half sine.
double hump(double s, std::uint64_t shape) {  // |s| up to 1
  if (std::abs(s) >= 1.0) return 0.0;
  if (shape == 0) return 0.5 + 0.5 * std::cos(0.5 * two_pi * s);
  return shape == 1 ? 1.0 - std::abs(s) : std::cos(0.25 * two_pi * s);
}

Effect bump(const Machine& machine, const Plan& plan, Engine& engine) {
  const ErrorName name = drawn_error(machine, true, engine);
  const auto [low, high] = range_of(plan, static_cast<AxisName>(name.body));
  const double width = drawn(engine, 50, 110) * rad_per_deg, centre = drawn(engine, low, high);
  const std::uint64_t shape = engine() % 3;
  TableError table;
  table.periodic = high - low > 5.0;
  const double from = table.periodic ? 0.0 : low - 1.0, to = table.periodic ? two_pi : high + 1.0;
  for (int k = 0; k <= 360; ++k) {
    const double at = from + (to - from) * k / 360.0;
    const double off = table.periodic ? std::remainder(at - centre, two_pi) : at - centre;
    table.at.push_back(at);
    table.values.push_back(hump(2.0 * off / width, shape));
  }
  Fault fault;
  fault.errors.terms.push_back({name, table, 0.0});
  return {"bump in " + to_string(name), {fault}, name.angular()};
}

// One step up or two, up and down again.
Effect steps(const Machine& machine, const Plan& plan, Engine& engine) {
  const ErrorName name = drawn_error(machine, false, engine);
  const auto [low, high] = range_of(plan, static_cast<AxisName>(name.body));
  const double length = high - low, first = low + drawn(engine, 0.2, 0.5) * length;
  const double second = engine() % 2 == 0 ? high + 1.0 : first + drawn(engine, 0.15, 0.35) * length;
  const double sharp = 1e-6 * length;
  TableError table;
  table.at = {low - 1.0, first, first + sharp, second, second + sharp};
  table.values = {0.0, 0.0, 1.0, 1.0, 0.0};
  Fault fault;
  fault.errors.terms.push_back({name, table, 0.0});
  return {"steps in " + to_string(name), {fault}, name.angular()};
}

// Of the axis itself times a smooth function of another one.
Effect of_two_axes(const Machine& machine, const Plan& plan, Engine& engine) {
  const ErrorName name = drawn_error(machine, false, engine);
  std::size_t other = name.body;
  while (other == name.body)
    other = index_of(machine.axes[one_of(engine, machine.axes.size())].name);
  const auto function = [&](std::size_t axis) -> std::function<double(double)> {
    const auto [low, high] = range_of(plan, static_cast<AxisName>(axis));
    const std::uint64_t shape = engine() % 4;
    if (high - low > 5.0 && axis >= 3) {
      const double order = shape == 0 ? 2.0 : 1.0, phase = drawn(engine, 0, two_pi);
      if (shape == 3) return [=](double q) { return std::abs(std::cos(0.5 * q + phase)); };
      return [=](double q) { return std::cos(order * q + phase); };
    }
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    return [=](double q) {
      const double s = (q - middle) / half;
      return shape == 0 ? s * s : shape == 1 ? s : shape == 2 ? std::exp(s) : std::abs(s);
    };
  };
  Fault fault;
  fault.of_visit = [name, other, own = function(name.body),
                    further = function(other)](const Visit& visit) -> std::vector<ErrorTerm> {
    const double value = own(visit.axes[name.body]) * further(visit.axes[other]);
    return {{name, ConstantError{value}, 0.0}};
  };
  return {"two axes, " + to_string(name) + " with " + "XYZABC" [other], { fault }, name.angular()};
}

// The course of a shift or a scale: 1 − exp(−t/τ), with two time constants, or up and down with a
// pause.
Effect warming(const Machine& machine, const Plan& plan, Engine& engine) {
  const double whole_s = plan.visits.back().time_s, tau = whole_s * drawn(engine, 0.06, 0.25);
  const double pause_s = whole_s * drawn(engine, 0.4, 0.7);
  const std::uint64_t shape = engine() % 3;
  ErrorName name = drawn_error(machine, false, engine);
  while (name.body >= 3) name = drawn_error(machine, false, engine);
  const bool scale = engine() % 2 == 0;
  if (scale) name.direction = name.body;
  if (!scale) name.direction %= 3;
  const auto [low, high] = range_of(plan, static_cast<AxisName>(name.body));
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  Fault fault;
  fault.of_visit = [=](const Visit& visit) -> std::vector<ErrorTerm> {
    double warm = 1.0 - std::exp(-visit.time_s / tau);
    if (shape == 1) warm = 0.6 * warm + 0.4 * (1.0 - std::exp(-0.2 * visit.time_s / tau));
    if (shape == 2 && visit.time_s > pause_s)
      warm = (1.0 - std::exp(-pause_s / tau)) * std::exp((pause_s - visit.time_s) / tau);
    const double along = scale ? (visit.axes[name.body] - middle) / half : 1.0;
    return {{name, ConstantError{warm * along}, 0.0}};
  };
  return {std::string("temperature, ") + (scale ? "scale of " : "shift ") + to_string(name),
          {fault},
          false};
}

}  // namespace

Effect drawn_unknown(const Machine& machine, const Plan& plan, int which, Engine& engine) {
  switch (which) {
    case 0:
      return bump(machine, plan, engine);
    case 1:
      return steps(machine, plan, engine);
    case 2:
      return of_two_axes(machine, plan, engine);
    default:
      return warming(machine, plan, engine);
  }
}

}  // namespace trueaxis::blind_machine
