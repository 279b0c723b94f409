// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "calibrate/diagnose/pattern.hpp"
#include "calibrate/estimate/geometry.hpp"
#include "calibrate/estimate/plausible_errors.hpp"
#include "calibrate/estimate/random_effects.hpp"
#include "calibrate/estimate/read_out.hpp"
#include "machine/error_name.hpp"

namespace trueaxis::calibrate_detail {
namespace {

/// 95 % of the sizes of component errors lie within this factor of their median (Eq. 210).
double factor_of_sizes() {
  const SizeSpread spread;
  return std::exp(1.96 * std::hypot(std::log(spread.group), std::log(spread.all)));
}

std::string consequence_of(const ErrorName& error, AxisName axis) {
  const std::string letter(1, letter_of(axis));
  const bool along = error.direction == error.body;
  const char* const what = is_rotary(axis) ? (along ? "scale or gear of " : "bearings of ")
                                           : (along ? "screw or scale of " : "guideway of ");
  return what + letter + ": compensate " + to_string(error);
}

/// @param order that the sizes fall off with (Eq. 210)
MachineEffect component(const ErrorName& error, AxisName axis, const char* kind, int order,
                        const std::string& form) {
  MachineEffect out;
  out.id = to_string(error) + '.' + kind + std::to_string(order);
  out.title = words_of(error) + ", " + form;
  out.term = ErrorOfPosition{error, {}, {}};
  out.unit = error.angular() ? "rad" : "mm";
  const double median = PlausibleSizes{}.of(is_rotary(axis), error.angular()) / order;
  out.low = median / factor_of_sizes(), out.high = median * factor_of_sizes();
  out.consequence = consequence_of(error, axis);
  return out;
}

void add_polynomials(AxisName axis, const AxisRange& range, const ErrorName& error,
                     std::vector<MachineEffect>& out) {
  const bool squareness = !is_rotary(axis) && !error.angular() && error.direction != error.body;
  const int last = !is_rotary(axis) && error.angular() ? 2 : 3;
  const char* const unit = is_rotary(axis) ? "rad" : "mm";
  for (int degree = squareness ? 2 : 1; degree <= last; ++degree) {
    MachineEffect one = component(error, axis, "poly", degree, "degree " + std::to_string(degree));
    std::get<ErrorOfPosition>(one.term).functions = {legendre(degree, range.low, range.high)};
    one.parameters = {"legendre"};
    one.formula = "legendre P_degree((2 q - low - high)/(high - low))";
    one.shape = {{"degree", static_cast<double>(degree), "1"},
                 {"low", range.low, unit},
                 {"high", range.high, unit}};
    out.push_back(std::move(one));
  }
}

constexpr std::array cyclic_orders{1, 2, 3, 4};

void add_harmonics(AxisName axis, const ErrorName& error, std::span<const int> orders,
                   std::vector<MachineEffect>& out) {
  for (const int order : orders) {
    MachineEffect one =
        component(error, axis, "harmonic", order, std::to_string(order) + " times per revolution");
    std::get<ErrorOfPosition>(one.term).functions = harmonic(order);
    one.parameters = {"cos", "sin"};
    one.formula = "cos cos(order q) + sin sin(order q)";
    one.shape = {{"order", static_cast<double>(order), "1"}};
    out.push_back(std::move(one));
  }
}

bool comes_from_both_sides(const Problem& problem, AxisName axis) {
  if (problem.read_outs())
    return std::ranges::any_of(
        problem.rows, [&](const Row& row) { return row.read_out == axis && row.sense != 0.0; });
  bool up = false, down = false;
  const std::vector<double> at = positions_of(problem, axis);
  for (std::size_t i = 1; i < at.size(); ++i) {
    up = up || at[i] - at[i - 1] > least_move, down = down || at[i] - at[i - 1] < -least_move;
  }
  return up && down;
}

MachineEffect reversal_of(const Problem& problem, AxisName axis) {
  const std::string letter(1, letter_of(axis));
  MachineEffect reversal;
  reversal.id = "reversal." + letter;
  reversal.title = "difference between the two senses of " + letter;
  reversal.term = ErrorOfSense{axis};
  reversal.parameters = {"size"};
  reversal.formula = "size/2 where the axis came from below, -size/2 where from above";
  reversal.unit = is_rotary(axis) ? "rad" : "mm";
  reversal.low = is_rotary(axis) ? 2e-6 : 0.5e-3, reversal.high = is_rotary(axis) ? 2e-4 : 0.03;
  reversal.consequence = "a program corrects it for one sense only, so its size is counted with U";
  if (!comes_from_both_sides(problem, axis))
    reversal.why_not = letter + " comes from one side only";
  return reversal;
}

void add_axis(const Problem& problem, AxisName axis, std::vector<MachineEffect>& out) {
  const AxisRange range = axis_range(problem, axis);
  const std::string letter(1, letter_of(axis));
  const char* const unit = is_rotary(axis) ? "rad" : "mm";
  if (range.length() < least_range) {
    MachineEffect any;
    any.id = "E*" + letter, any.title = "errors of " + letter, any.unit = unit;
    any.why_not = letter + " does not move in these rows";
    out.push_back(std::move(any));
    return;
  }
  for (std::size_t direction = 0; direction < 6; ++direction) {
    const ErrorName error{true, direction, index_of(axis)};
    if (direction == index_of(axis) && problem.has_read_out(axis)) continue;  // always fitted
    if (is_rotary(axis) && range.length() >= whole_turn)
      add_harmonics(axis, error, cyclic_orders, out);
    else
      add_polynomials(axis, range, error, out);
  }
  out.push_back(reversal_of(problem, axis));
}

/// Any period that the positions show.
MachineEffect periodic_of(const Problem& problem, AxisName axis, const ErrorName& error) {
  MachineEffect one = component(error, axis, "periodic", 1, "periodic in the position");
  one.id = to_string(error) + ".periodic";
  std::get<ErrorOfPosition>(one.term).periodic = true;
  one.parameters = {"cos", "sin"};
  one.formula = "cos cos(2 pi q/period) + sin sin(2 pi q/period)";
  if (periods_of(positions_of(problem, axis)).empty())
    one.why_not =
        "these positions are too few for a period to be looked for: read out 24 or more, "
        "closer than half of it";
  return one;
}

/// What lies between the positions.
MachineEffect fine_of(const Problem& problem, AxisName axis, const std::set<int>& orders,
                      const ErrorName& error) {
  const std::vector<double> all = positions_of(problem, axis);
  const std::set<double> different(all.begin(), all.end());
  const double apart =
      axis_range(problem, axis).length() / static_cast<double>(different.size() - 1);
  const std::string letter(1, letter_of(axis));
  MachineEffect one;
  one.id = to_string(error) + ".fine";
  one.title = "errors of " + letter + " between its positions";
  one.unit = error.angular() ? "rad" : "mm";
  one.why_not =
      !orders.empty()
          ? fmt::format("orders above {} were not read: read out closer positions",
                        *orders.rbegin())
          : fmt::format(
                "positions {:.3g} {} apart show no shorter period than twice that: read out "
                "closer positions",
                apart / (is_rotary(axis) ? rad_per_deg : 1.0), is_rotary(axis) ? "deg" : "mm");
  return one;
}

void add_zero(const Problem& problem, AxisName axis, std::vector<MachineEffect>& out) {
  const std::string letter(1, letter_of(axis)), what = "the zero of the read-out of " + letter;
  const TimeSpan times = times_of(problem, axis);
  MachineEffect drift;
  drift.id = "read_out." + letter + ".drift";
  drift.title = "drift of " + what;
  drift.term = ZeroDrift{axis};
  drift.parameters = {"over_all"};
  drift.formula = "over_all (t - begin)/(end - begin)";
  drift.shape = {{"begin", times.begin_s, "s"}, {"end", times.end_s, "s"}};
  drift.unit = is_rotary(axis) ? "rad" : "mm";
  drift.low = is_rotary(axis) ? 2e-6 : 0.5e-3, drift.high = is_rotary(axis) ? 2e-4 : 0.05;
  drift.consequence = "axis or instrument warmed up: read out again when they are warm";
  if (!(times.end_s > times.begin_s))
    drift.why_not = "the rows have no times: measure with a column t";
  MachineEffect step = drift;
  step.id = "read_out." + letter + ".step";
  step.title = "a step of " + what;
  step.term = ZeroStep{axis};
  step.parameters = {"size"};
  step.formula = "size from the row on";
  step.shape = {}, step.why_not = "";
  step.consequence = "the instrument or its reflector moved while the axis was read out";
  if (!problem.read_outs()) {
    MachineEffect scale = step;
    scale.id = "read_out." + letter + ".scale";
    scale.title = "scale of the read-out of " + letter + " against the ball";
    scale.term = ZeroScale{axis};
    scale.parameters = {"over_range"};
    scale.formula = "over_range ((q - low)/(high - low) - 1/2)";
    scale.consequence =
        "read-out and ball do not agree: check the temperature of the material, alignment and unit";
    out.push_back(std::move(scale));
  }
  out.push_back(std::move(drift));
  out.push_back(std::move(step));
}

/// What read-outs alone show: the position error of their axis, its reversal, and their own zero.
void add_read_out(const Problem& problem, AxisName axis, std::vector<MachineEffect>& out) {
  const std::string letter(1, letter_of(axis));
  const AxisRange range = axis_range(problem, axis);
  MachineEffect others;
  others.id = "E*" + letter, others.unit = is_rotary(axis) ? "rad" : "mm";
  if (range.length() < least_range) {
    others.title = "errors of " + letter, others.why_not = letter + " was not read out";
    out.push_back(std::move(others));
    return;
  }
  const ErrorName error{true, index_of(axis), index_of(axis)};
  others.title = "other errors of " + letter;
  others.why_not = "a read-out of " + letter + " shows " + to_string(error) +
                   " alone: measure a ball, a bar or an array";
  std::set<int> orders;
  for (const Row& row : problem.rows)
    if (row.read_out == axis)
      orders.insert(problem.targets[row.target].orders.begin(),
                    problem.targets[row.target].orders.end());
  if (orders.empty()) {
    add_polynomials(axis, range, error, out);
    out.push_back(periodic_of(problem, axis, error));
  } else {
    add_harmonics(axis, error, std::vector<int>(orders.begin(), orders.end()), out);
  }
  out.push_back(fine_of(problem, axis, orders, error));
  out.push_back(reversal_of(problem, axis));
  add_zero(problem, axis, out);
  out.push_back(std::move(others));
}

void add_drifts(const Problem& problem, bool timed, std::vector<MachineEffect>& out) {
  const TimeSpan times = times_of_tip(problem);
  for (std::size_t i = 0; i < 3; ++i) {
    MachineEffect drift;
    drift.id = std::string("drift.") + "XYZ"[i];
    drift.title = std::string("drift of the tip along ") + "XYZ"[i];
    drift.term = TipDrift{i};
    drift.parameters = {"over_all"};
    drift.formula = "over_all (t - begin)/(end - begin)";
    drift.shape = {{"begin", times.begin_s, "s"}, {"end", times.end_s, "s"}};
    drift.unit = "mm";
    drift.low = 0.5e-3, drift.high = 0.05;
    drift.consequence =
        "it continues while the part is cut, so what it was over the measurement is counted with U";
    if (!timed || !(times.end_s > times.begin_s))
      drift.why_not = "the rows have no times: measure with a column t";
    out.push_back(std::move(drift));
  }
}

}  // namespace

std::vector<MachineEffect> machine_effects(const Problem& problem, bool timed,
                                           std::span<const MachineEffect> own) {
  std::vector<MachineEffect> out;
  for (const MachineAxis& axis : problem.machine->axes)
    if (problem.read_outs())
      add_read_out(problem, axis.name, out);
    else
      add_axis(problem, axis.name, out);
  if (problem.read_outs()) {
    out.insert(out.end(), own.begin(), own.end());
    return out;
  }
  for (const MachineAxis& axis : problem.machine->axes)
    if (problem.has_read_out(axis.name)) add_zero(problem, axis.name, out);
  add_drifts(problem, timed, out);
  MachineEffect slip;
  slip.id = "ball.slip";
  slip.title = "a step of the ball on the table";
  slip.term = BallStep{};
  slip.parameters = {"x", "y", "z"};
  slip.formula = "(x, y, z) from the row on";
  slip.unit = "mm";
  slip.low = 1e-3, slip.high = 0.5;
  slip.consequence = "a ball moved on the table while it was measured";
  out.push_back(std::move(slip));
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

}  // namespace trueaxis::calibrate_detail
