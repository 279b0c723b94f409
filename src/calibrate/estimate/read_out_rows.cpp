// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/read_out_rows.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "trueaxis/error.hpp"

namespace trueaxis::calibrate_detail {

bool is_along(const Machine& machine, AxisName axis) {
  return std::abs(machine.find(axis)->direction[index_of(axis) % 3]) > 1.0 - 1e-9;
}

void add_read_out(Problem& problem, const MachineMeasurement& file, std::size_t number,
                  bool with_reversal) {
  const AxisName axis = *file.axis;
  std::vector<double> position;
  for (const AxisPositions& at : file.axes) position.push_back(at[index_of(axis)]);
  Target target;
  target.file = number;
  target.zero = true;
  if (is_rotary(axis)) target.orders = orders_of_turn(position, file.gear_ratio);
  const std::vector<double> sense = senses_of(position);
  target.two_ways = with_reversal && !sense.empty();
  target.first = problem.places;
  problem.places += target.unknowns();
  for (std::size_t i = 0; i < file.rows(); ++i) {
    Row row;
    row.file = number;
    row.row = i;
    row.kind = file.kind;
    row.read_out = axis;
    row.axes = file.axes[i];
    row.target = problem.targets.size();
    if (!sense.empty()) row.sense = sense[i];
    if (!file.time_s.empty()) row.time_s = file.time_s[i];
    row.observed[0] = file.actual[i] - position[i];
    row.sigma_mm = file.noise_mm.value_or(is_rotary(axis) ? unstated_noise_rad : unstated_noise_mm);
    row.first = problem.equations++;
    problem.rows.push_back(row);
  }
  problem.targets.push_back(std::move(target));
  if (!with_reversal) problem.noise_stated = problem.noise_stated && file.noise_mm;
}

double read_out_error(const Machine& machine, const ErrorModel& errors, const Row& row) {
  return read_out_error(*machine.find(*row.read_out), errors, row.axes[index_of(*row.read_out)]);
}

void check_directions(const Machine& machine, std::span<const MachineMeasurement> data) {
  std::vector<Diagnostic> wrong;
  for (const MachineMeasurement& file : data) {
    if (is_along(machine, *file.axis)) continue;
    const std::string letter(1, letter_of(*file.axis));
    wrong.push_back({file.source, 0, 0,
                     letter + " is not along " + "XYZ"[index_of(*file.axis) % 3] +
                         " of the machine, so a read-out of it is not diagnosed alone: add a "
                         "measurement of kind ball, or run `trueaxis machine calibrate`, which "
                         "states its orders, reversal and noise"});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

/// Numbers that its own fit has: with the zero, and the reversal value.
std::size_t unknowns_of(const AxisReadOut& one) {
  return one.polynomial.size() + 2 * one.orders.size() + (one.reversal ? 1 : 0);
}

const AxisReadOut& read_out_of_file(std::span<const MachineMeasurement> data,
                                    std::span<const AxisReadOut> read_outs, std::size_t number) {
  const auto before =
      std::ranges::count(data.first(number), MeasurementKind::axis, &MachineMeasurement::kind);
  return read_outs[static_cast<std::size_t>(before)];
}

void take_noise(std::span<const MachineMeasurement> data, std::span<const AxisReadOut> read_outs,
                Problem& problem) {
  for (Row& row : problem.rows) {
    if (!row.read_out || data[row.file].noise_mm) continue;
    const double noise = read_out_of_file(data, read_outs, row.file).noise;
    if (!(noise > 0.0)) continue;
    row.sigma_mm = noise;
    problem.weights[row.first] = 1.0 / noise;
  }
}

void add_read_out_unknowns(const AxisReadOut& read_out, double largest,
                           std::vector<Unknown>& unknowns) {
  const ErrorName name{true, index_of(read_out.axis), index_of(read_out.axis)};
  const auto add = [&](const std::string& what, ErrorFunction function) {
    const std::string full = to_string(name) + '.' + what;
    if (std::ranges::find(unknowns, full, &Unknown::name) != unknowns.end()) return;
    unknowns.push_back({full, {name, std::move(function), 0.0}, largest});
  };
  for (std::size_t degree = 1; degree < read_out.polynomial.size(); ++degree)
    add("poly" + std::to_string(degree),
        legendre(static_cast<int>(degree), read_out.low, read_out.high));
  for (const AxisReadOut::Order& one : read_out.orders) {
    const auto order = static_cast<double>(one.order);
    add("cos" + std::to_string(one.order), FourierError{{{order, 1.0, 0.0}}, read_out.period});
    add("sin" + std::to_string(one.order), FourierError{{{order, 0.0, 1.0}}, read_out.period});
  }
}

}  // namespace trueaxis::calibrate_detail
