// SPDX-License-Identifier: Apache-2.0
#include "compensate/block_end.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "machine/compensations.hpp"

namespace trueaxis {
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
                                        const Setting& setting) {
  return task.options.method == CompensationMethod::exact
             ? compensate_exactly(task.model, axes, setting)
             : compensate_by_differential(task.model, axes, setting);
}

bool is_reached(const CompensatedPosition& position, std::size_t line, Tally& tally) {
  if (position.status == CompensationStatus::singular)
    tally.sums.singular.push_back({line, position.direction_left_rad});
  const bool reached = position.status == CompensationStatus::compensated ||
                       position.status == CompensationStatus::singular;
  if (!reached) tally.sums.unreachable.push_back({line, position.why});
  return reached;
}

BlockEnd compensate_end(const CompensationTask& task, const nc::Move& move, Tally& tally) {
  const std::size_t line = task.line_of(move);
  const Setting setting = task.axes.setting(move.modal);
  BlockEnd end;
  const auto commanded = task.axes.positions(move.words, move.modal);
  if (!commanded) {
    tally.sums.unreachable.push_back({line, "the linear axes cannot put the tip there"});
    return end;
  }
  end.commanded = *commanded;
  const ToolPose target = task.model.nominal(end.commanded, setting);
  end.tip_mm = target.tip_mm;
  CompensatedPosition position;
  ToolPose before;
  AxisPositions by_other_method;
  if (task.options.method == CompensationMethod::exact) {
    auto exact = compensate_exactly_with_before(task.model, target, end.commanded, setting);
    position = std::move(exact.position);
    before = exact.before;
    by_other_method = axes_by_differential(task.model, end.commanded, setting);
  } else {
    position = compensate_by_differential(task.model, end.commanded, setting);
    before = task.model.actual(end.commanded, setting);
    by_other_method = compensate_exactly(task.model, target, end.commanded, setting).axes;
  }
  end.actual_mm = before.tip_mm;
  take(tally.sums.before, before, target, line);
  take_single_errors(task, end.commanded, setting, line, tally);
  end.reached = is_reached(position, line, tally);
  if (!end.reached) return end;
  end.words = task.axes.words(move.words, end.commanded, position.axes, move.modal);
  const auto written = task.axes.positions(nc::as_written(move, end.words, task.write), move.modal);
  end.written = written.value_or(position.axes);
  for (std::size_t k = 0; k < axis_count; ++k) {
    if (!nc::has(task.axes.axes(), k)) continue;
    take(tally.sums.largest_change[k], end.words[k] - move.words[k], line);
    take(tally.sums.exact_minus_differential[k], position.axes[k] - by_other_method[k], line);
  }
  const ToolPose after = task.model.actual(end.written, setting);
  end.written_mm = after.tip_mm;
  take(tally.sums.after, after, target, line);
  const bool there = position.tip_left_mm < 1e-11 && position.direction_left_rad < 1e-13;
  take(tally.sums.rounding, after, there ? target : task.model.actual(position.axes, setting),
       line);
  take(tally.sums.about_tool_axis, position.about_tool_axis_rad, line);
  return end;
}

}  // namespace trueaxis
