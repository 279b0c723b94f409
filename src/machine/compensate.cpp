// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "machine/compensations.hpp"
#include "machine/correction_step.hpp"
#include "machine/limits.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
using Compiled = MachineModel::Compiled;
using Left = CorrectionStep::Left;

constexpr int largest_count = 60;
constexpr double lever_mm = 100.0;         ///< by which a turn counts as a length
constexpr double fine_mm = 1e-12;          ///< a step that changes nothing
constexpr double exact_tip_mm = 1e-8;      ///< more that is left: the tip cannot be put there
constexpr double exact_direction = 1e-10;  ///< more that is left, rad: a pole

struct Target {
  Vector3d tip, direction;
};

Left left_of(const Compiled& machine, const rigid::Motion& tool, const Target& target) {
  const Vector3d off = tool.R * machine.tool_direction - target.direction;
  return {tool.t - target.tip, off - target.direction.dot(off) * target.direction};
}

AxisPositions sum(const AxisPositions& a, const AxisPositions& b) {
  AxisPositions out;
  for (std::size_t k = 0; k < axis_count; ++k) out[k] = a[k] + b[k];
  return out;
}

double size_of(const AxisPositions& a, const AxisPositions& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < axis_count; ++k)
    largest = std::fmax(largest, std::fabs(a[k] - b[k]) * (k < 3 ? 1.0 : lever_mm));
  return largest;
}

/// The machine's own axes of `near`, no others.
AxisPositions of_machine(const Machine& machine, const AxisPositions& near) {
  AxisPositions axes{};
  for (const MachineAxis& axis : machine.axes)
    axes[index_of(axis.name)] = near[index_of(axis.name)];
  return axes;
}

/// A machine's way to a target from where its axes were commanded.
struct Problem {
  const Compiled& machine;
  const Target& target;
  const AxisPositions& near;
  const Setting& setting;
  const HeldAxes& held;

  rigid::Motion tool(const AxisPositions& change) const {
    return actual_tool(machine, sum(near, change), setting);
  }
  ToolMotion motion(const AxisPositions& change) const {
    return actual_motion(machine, sum(near, change), setting);
  }
};

struct Solution {
  AxisPositions change{};
  rigid::Motion tool;    ///< with it
  rigid::Motion before;  ///< where the method began: as commanded, but for axes that are held
};

bool direction_met(const Left& left) { return left.direction.norm() <= exact_direction; }

/// Newton's method with a Jacobian that is kept as long as it serves: the errors turn it by some
/// 1e-4, so that each step removes four digits of the rest. If a direction is left, the Jacobian
/// says where it is least, and only a fresh one is right.
Solution solve(const Problem& problem) {
  const Compiled& machine = problem.machine;
  const ToolMotion motion = problem.motion(problem.held.change);
  Solution now{problem.held.change, motion.tool, motion.tool};
  CorrectionStep step(machine, motion, problem.held);
  bool fresh = true;
  double before = INFINITY;
  for (int i = 0; i < largest_count; ++i) {
    const AxisPositions next = step.total(now.change, left_of(machine, now.tool, problem.target),
                                          machine.machine.max_rotary_change_rad);
    const double size = size_of(next, now.change);
    now.change = next;
    now.tool = problem.tool(next);
    const bool slow = i > 0 && size > 0.02 * before;
    const bool still = size <= fine_mm || (i > 0 && !slow && size * size / before <= fine_mm);
    if (still &&
        (fresh || !step.turns() || direction_met(left_of(machine, now.tool, problem.target))))
      break;
    fresh = still || slow;
    if (fresh) step = CorrectionStep(machine, problem.motion(next), problem.held);
    before = size;
  }
  return now;
}

/// Whether rotary axes are there, and free, to meet the direction.
bool corrects_direction(const Machine& machine, const HeldAxes& held) {
  const bool one_held = std::ranges::any_of(machine.axes, [&](const MachineAxis& axis) {
    return is_rotary(axis.name) && held.holds(static_cast<std::size_t>(axis.name));
  });
  return !one_held && machine.rotary_count() >= 2 && machine.linear_count() >= 3;
}

bool at_largest_change(const Machine& machine, const AxisPositions& change) {
  for (const MachineAxis& axis : machine.axes)
    if (is_rotary(axis.name) &&
        std::abs(change[index_of(axis.name)]) >= machine.max_rotary_change_rad * (1.0 - 1e-9))
      return true;
  return false;
}

CompensatedPosition result_of(const MachineModel& model, const ToolPose& target,
                              const AxisPositions& near, const Solution& solution) {
  CompensatedPosition result;
  result.axes = sum(near, solution.change);
  const ToolPose pose = model.compiled().pose(solution.tool);
  result.tip_left_mm = (solution.tool.t - rigid::eigen(target.tip_mm)).norm();
  result.direction_left_rad = angle_between_rad(pose.direction, target.direction);
  result.about_tool_axis_rad = about_tool_axis_rad(pose, target);
  return result;
}

/// If an axis leaves its limits, the result does not count.
void refuse_outside(CompensatedPosition& result, const Machine& machine) {
  for (const MachineAxis& axis : machine.axes) {
    if (within(axis, result.axes[index_of(axis.name)])) continue;
    result.status = CompensationStatus::outside;
    result.why = outside_limits(machine, result.axes);
    return;
  }
}

}  // namespace

ExactCompensation compensate_exactly_with_before(const MachineModel& model, const ToolPose& target,
                                                 const AxisPositions& near, const Setting& setting,
                                                 const HeldAxes& held) {
  const Compiled& machine = model.compiled();
  const AxisPositions from = of_machine(machine.machine, near);
  const Target wanted{rigid::eigen(target.tip_mm), rigid::eigen(target.direction)};
  const Solution solution = solve({machine, wanted, from, setting, held});
  CompensatedPosition result = result_of(model, target, from, solution);
  if (!(result.tip_left_mm <= exact_tip_mm)) {
    result.status = CompensationStatus::unreachable;
    result.why = fmt::format("the tip stays {:.6f} mm off", result.tip_left_mm);
  } else if (corrects_direction(machine.machine, held) &&
             result.direction_left_rad > exact_direction) {
    result.status = CompensationStatus::singular;
  }
  refuse_outside(result, machine.machine);
  const bool as_commanded = held.change == AxisPositions{};
  return {std::move(result),
          machine.pose(as_commanded ? solution.before : actual_tool(machine, from, setting))};
}

CompensatedPosition compensate_exactly(const MachineModel& model, const ToolPose& target,
                                       const AxisPositions& near, const Setting& setting) {
  return compensate_exactly_with_before(model, target, near, setting).position;
}

CompensatedPosition compensate_exactly(const MachineModel& model, const AxisPositions& commanded,
                                       const Setting& setting) {
  return compensate_exactly(model, model.nominal(commanded, setting), commanded, setting);
}

namespace {

struct DifferentialChange {
  AxisPositions change{};
  bool near_pole = false;
};

DifferentialChange differential_change(const Compiled& machine, const AxisPositions& from,
                                       const Setting& setting, const HeldAxes& held) {
  const ToolMotion motion = nominal_motion(machine, from, setting);
  const Screw error = linear_error_screw(machine, from, setting);
  Left left{error.of_point(motion.tool.t), error.w.cross(motion.direction(machine))};
  for (const Joint& joint : machine.joints) {
    const double change = held.change[joint.axis];
    if (change == 0.0) continue;
    left.tip += change * motion.axes[joint.axis].of_point(motion.tool.t);
    left.direction += change * motion.axes[joint.axis].w.cross(motion.direction(machine));
  }
  const CorrectionStep step(machine, motion, held);
  return {step.total(held.change, left, machine.machine.max_rotary_change_rad), step.near_pole()};
}

}  // namespace

AxisPositions axes_by_differential(const MachineModel& model, const AxisPositions& commanded,
                                   const Setting& setting, const HeldAxes& held) {
  const AxisPositions from = of_machine(model.machine(), commanded);
  return sum(from, differential_change(model.compiled(), from, setting, held).change);
}

CompensatedPosition compensate_by_differential(const MachineModel& model,
                                               const AxisPositions& commanded,
                                               const Setting& setting, const HeldAxes& held) {
  const Compiled& machine = model.compiled();
  const AxisPositions from = of_machine(machine.machine, commanded);
  const DifferentialChange found = differential_change(machine, from, setting, held);
  Solution solution;
  solution.change = found.change;
  solution.tool = actual_tool(machine, sum(from, solution.change), setting);
  CompensatedPosition result = result_of(model, model.nominal(from, setting), from, solution);
  if (corrects_direction(machine.machine, held) &&
      (found.near_pole || at_largest_change(machine.machine, solution.change)))
    result.status = CompensationStatus::singular;
  refuse_outside(result, machine.machine);
  return result;
}

CompensatedPosition compensate_by_differential(const MachineModel& model,
                                               const AxisPositions& commanded,
                                               const Setting& setting) {
  return compensate_by_differential(model, commanded, setting, {});
}

}  // namespace trueaxis
