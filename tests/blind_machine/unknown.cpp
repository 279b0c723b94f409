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

// A raised cosine, 50 to 110° wide at its foot.
Effect bump(const Machine& machine, const Plan& plan, Engine& engine) {
  const ErrorName name = drawn_error(machine, true, engine);
  const auto [low, high] = range_of(plan, static_cast<AxisName>(name.body));
  const double width = drawn(engine, 50, 110) * rad_per_deg, centre = drawn(engine, low, high);
  TableError table;
  table.periodic = high - low > 5.0;
  const double from = table.periodic ? 0.0 : low - 1.0, to = table.periodic ? two_pi : high + 1.0;
  for (int k = 0; k <= 360; ++k) {
    const double at = from + (to - from) * k / 360.0;
    const double off = table.periodic ? std::remainder(at - centre, two_pi) : at - centre;
    table.at.push_back(at);
    table.values.push_back(std::abs(off) < 0.5 * width ? 0.5 + 0.5 * std::cos(two_pi * off / width)
                                                       : 0.0);
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
    const bool even = engine() % 2 == 0;
    if (high - low > 5.0 && axis >= 3) {
      const double order = even ? 2.0 : 1.0, phase = drawn(engine, 0, two_pi);
      return [=](double q) { return std::cos(order * q + phase); };
    }
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    return [=](double q) {
      const double s = (q - middle) / half;
      return even ? 1.5 * s * s - 0.5 : s;
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

// 1 − exp(−t/τ) of a shift, or of a scale.
Effect warming(const Machine& machine, const Plan& plan, Engine& engine) {
  const double tau = plan.visits.back().time_s * drawn(engine, 0.06, 0.25);
  ErrorName name = drawn_error(machine, false, engine);
  while (name.body >= 3) name = drawn_error(machine, false, engine);
  const bool scale = engine() % 2 == 0;
  if (scale) name.direction = name.body;
  if (!scale) name.direction %= 3;
  const auto [low, high] = range_of(plan, static_cast<AxisName>(name.body));
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  Fault fault;
  fault.of_visit = [=](const Visit& visit) -> std::vector<ErrorTerm> {
    const double warm = 1.0 - std::exp(-visit.time_s / tau);
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
