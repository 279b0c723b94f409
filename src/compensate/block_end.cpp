// SPDX-License-Identifier: Apache-2.0
#include "compensate/block_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "machine/compensations.hpp"
#include "machine/limits.hpp"

namespace trueaxis {
namespace {

constexpr double lever_mm = 1000.0;

double length_of(const ErrorFunction& function) {
  double least = INFINITY;
  if (const auto* polynomial = std::get_if<PolynomialError>(&function)) {
    if (polynomial->coefficients.size() > 2)
      least = std::abs(polynomial->scale) / static_cast<double>(polynomial->coefficients.size());
  } else if (const auto* waves = std::get_if<FourierError>(&function)) {
    for (const FourierError::Term& term : waves->terms)
      if (term.order != 0.0) least = std::min(least, 0.25 * std::abs(waves->period / term.order));
  } else if (const auto* table = std::get_if<TableError>(&function)) {
    for (std::size_t i = 1; i < table->at.size(); ++i)
      least = std::min(least, table->at[i] - table->at[i - 1]);
  }
  return least;
}

/// Beyond a table's ends its value is held, or the table begins again: with a step, where its ends
/// differ.
double corner_of(const TableError& table) {
  if (table.at.size() < 2) return 0.0;
  if (table.periodic && table.values.front() != table.values.back()) return INFINITY;
  double largest = 0.0, before = 0.0;
  for (std::size_t i = 1; i < table.at.size(); ++i) {
    const double slope = (table.values[i] - table.values[i - 1]) / (table.at[i] - table.at[i - 1]);
    largest = std::max(largest, std::abs(slope - before));
    before = slope;
  }
  const double first = (table.values[1] - table.values[0]) / (table.at[1] - table.at[0]);
  return std::max(largest, table.periodic ? std::abs(first - before) : std::abs(before));
}

}  // namespace

double ErrorBends::off_mm(std::size_t axis, double from, double to) const {
  if (from == to || corner_mm[axis] == 0.0) return 0.0;
  const auto& at = corners[axis];
  const auto first = std::ranges::lower_bound(at, std::min(from, to));
  const bool some = corner_everywhere[axis] || (first != at.end() && *first <= std::max(from, to));
  return some ? 0.25 * corner_mm[axis] * std::abs(to - from) : 0.0;
}

ErrorBends bends_of(const ErrorModel& errors) {
  ErrorBends bends;
  bends.length.fill(INFINITY);
  bends.corner_mm.fill(0.0);
  for (const ErrorTerm& term : errors.terms) {
    if (!term.name.component) continue;
    const std::size_t axis = term.name.body;
    bends.length[axis] = std::min(bends.length[axis], length_of(term.function));
    const auto* table = std::get_if<TableError>(&term.function);
    if (table == nullptr) continue;
    bends.corner_mm[axis] += corner_of(*table) * (term.name.angular() ? lever_mm : 1.0);
    bends.corners[axis].insert(bends.corners[axis].end(), table->at.begin(), table->at.end());
    bends.corner_everywhere[axis] = bends.corner_everywhere[axis] || table->periodic;
  }
  for (std::vector<double>& at : bends.corners) std::ranges::sort(at);
  return bends;
}

CompensationTask::CompensationTask(const MachineModel& model_of, const nc::Program& program_of,
                                   const CompensationOptions& options_of,
                                   const ProgramAxes& axes_of)
    : model(model_of),
      program(program_of),
      options(options_of),
      axes(axes_of),
      write{options_of.decimals, options_of.angle_decimals, axes_of.axes()},
      by_error(SingleErrors::of_names(model_of)),
      uncertainty(model_of),
      bends(bends_of(model_of.errors())) {}

namespace {

void take_single_errors(const CompensationTask& task, const AxisPositions& axes,
                        const Setting& setting, std::size_t line, Tally& tally) {
  thread_local std::vector<double> tip_mm;
  tip_mm.resize(task.by_error.names().size());
  tally.by_error.resize(tip_mm.size());
  task.by_error.tip_mm(axes, setting, tip_mm);
  for (std::size_t i = 0; i < tip_mm.size(); ++i) take(tally.by_error[i], tip_mm[i], line);
  if (task.uncertainty.stated()) take(tally.u_tip, task.uncertainty.u_mm(axes, setting), line);
}

}  // namespace

CompensatedPosition compensate_position(const CompensationTask& task, const AxisPositions& axes,
                                        const Setting& setting, const HeldAxes& held) {
  if (task.options.method == CompensationMethod::differential)
    return compensate_by_differential(task.model, axes, setting, held);
  const ToolPose target = task.model.nominal(axes, setting);
  return compensate_exactly_with_before(task.model, target, axes, setting, held).position;
}

bool is_reached(const CompensatedPosition& position, std::size_t line, Tally& tally) {
  if (position.status == CompensationStatus::singular)
    tally.sums.singular.push_back({line, position.direction_left_rad});
  const bool reached = position.status == CompensationStatus::compensated ||
                       position.status == CompensationStatus::singular;
  if (!reached) tally.sums.unreachable.push_back({line, position.why});
  return reached;
}

namespace {

/// Where the move ends as it was read; nothing where no axis position has its tip.
std::optional<BlockEnd> as_read(const CompensationTask& task, const nc::Move& move, Tally& tally) {
  const auto commanded = task.axes.positions(move.words, move.modal);
  if (!commanded) {
    tally.sums.unreachable.push_back(
        {task.line_of(move), "the linear axes cannot put the tip there"});
    return std::nullopt;
  }
  if (std::string why = outside_known(task.model.errors(), *commanded); !why.empty()) {
    tally.sums.unreachable.push_back({task.line_of(move), std::move(why)});
    return std::nullopt;
  }
  BlockEnd end;
  end.commanded = *commanded;
  return end;
}

void take_before(const CompensationTask& task, const nc::Move& move, const ToolPose& target,
                 const ToolPose& before, BlockEnd& end, Tally& tally) {
  end.tip_mm = target.tip_mm;
  end.actual_mm = before.tip_mm;
  end.before_mm = distance_mm(before.tip_mm, target.tip_mm);
  take(tally.sums.before, before, target, task.line_of(move));
  take_single_errors(task, end.commanded, task.axes.setting(move.modal), task.line_of(move), tally);
}

void take_after(const CompensationTask& task, const nc::Move& move, const ToolPose& target,
                const ToolPose& after, BlockEnd& end, Tally& tally) {
  end.reached = true;
  end.written_mm = after.tip_mm;
  end.after_mm = distance_mm(after.tip_mm, target.tip_mm);
  take(tally.sums.after, after, target, task.line_of(move));
}

}  // namespace

BlockEnd compensate_end(const CompensationTask& task, const nc::Move& move, const HeldAxes& held,
                        Tally& tally) {
  const std::size_t line = task.line_of(move);
  const Setting setting = task.axes.setting(move.modal);
  std::optional<BlockEnd> read = as_read(task, move, tally);
  if (!read) return {};
  BlockEnd& end = *read;
  const ToolPose target = task.model.nominal(end.commanded, setting);
  CompensatedPosition position;
  ToolPose before;
  AxisPositions by_other_method;
  auto exact = compensate_exactly_with_before(task.model, target, end.commanded, setting, held);
  if (task.options.method == CompensationMethod::exact) {
    position = std::move(exact.position);
    before = exact.before;
    by_other_method = axes_by_differential(task.model, end.commanded, setting, held);
  } else {
    position = compensate_by_differential(task.model, end.commanded, setting, held);
    before = task.model.actual(end.commanded, setting);
    by_other_method = exact.position.axes;
  }
  take_before(task, move, target, before, end, tally);
  if (!is_reached(position, line, tally)) return end;
  end.words = task.axes.words(move.words, end.commanded, position.axes, move.modal);
  const auto written = task.axes.positions(nc::as_written(move, end.words, task.write), move.modal);
  end.written = written.value_or(position.axes);
  for (std::size_t k = 0; k < axis_count; ++k) {
    if (!nc::has(task.axes.axes(), k)) continue;
    take(tally.sums.largest_change[k], end.words[k] - move.words[k], line);
    take(tally.sums.exact_minus_differential[k], position.axes[k] - by_other_method[k], line);
  }
  const ToolPose after = task.model.actual(end.written, setting);
  take_after(task, move, target, after, end, tally);
  const bool there = position.tip_left_mm < 1e-11 && position.direction_left_rad < 1e-13;
  const ToolPose unrounded = there ? target : task.model.actual(position.axes, setting);
  take(tally.sums.rounding, after, unrounded, line);
  take(tally.sums.about_tool_axis, position.about_tool_axis_rad, line);
  return end;
}

}  // namespace trueaxis
