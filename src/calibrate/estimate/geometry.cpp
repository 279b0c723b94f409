// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/geometry.hpp"

#include <algorithm>
#include <limits>

#include "machine/screw.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Vector3d;

/// −∂(observed − predicted)/∂ε of a constant component error, by a forward difference: 1e-3 mm and
/// 1e-5 rad leave a part of 1e-5 and less of the column.
void fill_unit_errors(const Problem& problem, const ErrorModel& errors, const VectorXd& places,
                      MatrixXd& out) {
  const auto& axes = problem.machine->axes;
  out.resize(problem.equations, static_cast<Index>(6 * axes.size()));
  const VectorXd here = problem.residuals(errors, places);
  ErrorModel moved = errors;
  moved.terms.emplace_back();
  for (std::size_t k = 0; k < axes.size(); ++k)
    for (std::size_t direction = 0; direction < 6; ++direction) {
      const double h = direction < 3 ? 1e-3 : 1e-5;
      moved.terms.back() = {{true, direction, index_of(axes[k].name)}, ConstantError{h}, 0.0};
      out.col(static_cast<Index>(6 * k + direction)) =
          (here - problem.residuals(moved, places)) / h;
    }
}

}  // namespace

std::vector<double> positions_of(const Problem& problem, AxisName axis) {
  std::vector<double> out;
  for (const Row& row : problem.rows)
    if (problem.tells_of(row, axis)) out.push_back(row.axes[index_of(axis)]);
  return out;
}

namespace {

template <class Which>
TimeSpan times_of_rows(const Problem& problem, const Which& which) {
  TimeSpan out{std::numeric_limits<double>::max(), 0.0};
  for (const Row& row : problem.rows)
    if (which(row)) out = {std::min(out.begin_s, row.time_s), std::max(out.end_s, row.time_s)};
  return out;
}

}  // namespace

TimeSpan times_of(const Problem& problem, AxisName axis) {
  return times_of_rows(problem, [&](const Row& row) { return row.read_out == axis; });
}

TimeSpan times_of_tip(const Problem& problem) {
  return times_of_rows(problem,
                       [&](const Row& row) { return !row.read_out || problem.read_outs(); });
}

AxisRange axis_range(const Problem& problem, AxisName axis) {
  const std::vector<double> at = positions_of(problem, axis);
  if (at.empty()) return {};
  const auto [low, high] = std::ranges::minmax(at);
  return {low, high};
}

std::optional<std::array<double, 2>> measured_over(const Problem& problem, const ErrorTerm& error) {
  if (!error.name.component || std::holds_alternative<ConstantError>(error.function)) return {};
  const std::size_t axis = error.name.body;
  const bool of_read_out = error.name.direction == axis;
  std::vector<double> at;
  for (const Row& row : problem.rows)
    if (row.of_tip() || (of_read_out && index_of(*row.read_out) == axis))
      at.push_back(row.axes[axis]);
  if (at.empty()) return {};
  const auto [low, high] = std::ranges::minmax(at);
  const bool rotary = is_rotary(static_cast<AxisName>(axis));
  const bool all_around =
      rotary && std::holds_alternative<FourierError>(error.function) && high - low >= whole_turn;
  if (all_around || high - low < (rotary ? rad_per_deg : 1.0)) return {};
  return std::array{low, high};
}

VectorXd error_column(const Problem& problem, const Geometry& geometry, const ErrorTerm& error,
                      std::optional<AxisName> of) {
  const auto& axes = problem.machine->axes;
  const auto own =
      std::ranges::find(axes, static_cast<AxisName>(error.name.body), &MachineAxis::name);
  const std::size_t by = of ? index_of(*of) : error.name.body;
  return times_rows(
      problem,
      geometry.unit_errors.col(6 * (own - axes.begin()) + static_cast<Index>(error.name.direction)),
      [&](const Row& row) { return value_at(error.function, row.axes[by]); });
}

Geometry geometry_of(const Problem& problem, const ErrorModel& errors, const VectorXd& places) {
  Geometry out;
  fill_unit_errors(problem, errors, places, out.unit_errors);
  out.places = problem.places_jacobian(errors, places);
  out.tip_shift = MatrixXd::Zero(problem.equations, 3);
  out.part_shift = MatrixXd::Zero(problem.equations, 3);
  const MachineModel model(*problem.machine, errors);
  for (const Row& row : problem.rows) {
    const Index n = row.equations();
    const Target& target = problem.targets[row.target];
    if (target.zero) continue;
    // ∂/∂(place) = g R_w, where g is what the equations see of a shift of the ball in M.
    const MatrixXd place = out.places.block(row.first, target.first, n, 3);
    const rigid::Motion workpiece = actual_ends(model.compiled(), row.axes).workpiece;
    out.part_shift.middleRows(row.first, n) = place;
    out.tip_shift.middleRows(row.first, n) = -place * workpiece.R.transpose();
  }
  return out;
}

}  // namespace trueaxis::calibrate_detail
