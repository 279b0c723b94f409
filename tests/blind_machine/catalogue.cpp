// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/catalogue.hpp"

#include <algorithm>

namespace trueaxis::blind_machine {
namespace {

Fault of_error(ErrorTerm term) {
  Fault out;
  out.errors.terms.push_back(std::move(term));
  return out;
}

void add_component(const Plan& plan, AxisName axis, std::size_t direction,
                   std::vector<Effect>& out) {
  const auto [low, high] = range_of(plan, axis);
  const ErrorName name{true, direction, index_of(axis)};
  const std::string text = to_string(name);
  if (is_rotary(axis) && high - low >= 300.0 * rad_per_deg) {
    for (int n = 1; n <= 4; ++n) {
      const auto order = static_cast<double>(n);
      out.push_back({text + ".harmonic" + std::to_string(n),
                     {of_error({name, FourierError{{{order, 1.0, 0.0}}, two_pi}, 0.0}),
                      of_error({name, FourierError{{{order, 0.0, 1.0}}, two_pi}, 0.0})},
                     name.angular()});
    }
    return;
  }
  const bool linear = !is_rotary(axis),
             squareness = linear && direction < 3 && direction != name.body;
  const int last = linear && direction >= 3 ? 2 : 3;
  for (int degree = squareness ? 2 : 1; degree <= last; ++degree)
    out.push_back({text + ".poly" + std::to_string(degree),
                   {of_error(unit_polynomial(name, degree, low, high))},
                   name.angular()});
}

/// Whether an axis comes from both sides.
bool comes_back(const Plan& plan, std::size_t axis) {
  bool up = false, down = false;
  for (std::size_t i = 1; i < plan.visits.size(); ++i) {
    const double move = plan.visits[i].axes[axis] - plan.visits[i - 1].axes[axis];
    up = up || move > 1e-9;
    down = down || move < -1e-9;
  }
  return up && down;
}

}  // namespace

std::pair<double, double> range_of(const Plan& plan, AxisName axis) {
  const auto at = [&](const Visit& visit) { return visit.axes[index_of(axis)]; };
  const auto [low, high] = std::ranges::minmax_element(plan.visits, {}, at);
  return {at(*low), at(*high)};
}

ErrorTerm unit_polynomial(const ErrorName& name, int degree, double low, double high) {
  const std::vector<double> legendre[] = {
      {1.0}, {0.0, 1.0}, {-0.5, 0.0, 1.5}, {0.0, -1.5, 0.0, 2.5}};
  return {name, PolynomialError{legendre[degree], 0.5 * (low + high), 0.5 * (high - low)}, 0.0};
}

std::vector<Effect> catalogue(const Machine& machine, const Plan& plan) {
  std::vector<Effect> out;
  for (const MachineAxis& axis : machine.axes) {
    for (std::size_t direction = 0; direction < 6; ++direction)
      add_component(plan, axis.name, direction, out);
    if (!comes_back(plan, index_of(axis.name))) continue;
    Fault fault;
    fault.reversal[index_of(axis.name)] = 1.0;
    out.push_back({std::string("reversal.") + letter_of(axis.name), {fault}, is_rotary(axis.name)});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Fault fault;
    fault.drift_mm[i] = 1.0;
    out.push_back({std::string("drift.") + "XYZ" [i], { fault }, false});
  }
  return out;
}

}  // namespace trueaxis::blind_machine
