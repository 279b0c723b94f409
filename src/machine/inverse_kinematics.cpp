// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "machine/limits.hpp"
#include "machine/rotary_solutions.hpp"
#include "machine/screw.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
using Compiled = MachineModel::Compiled;

constexpr double reached_mm = 1e-6;  ///< of a tip that fewer than three linear axes must meet

using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>;

/// The linear axes at these rotary positions: where the tip goes with them, and the distance to the
/// tip where they are. They enter the tip linearly.
struct LinearProblem {
  LinearProblem(const Compiled& machine, const Vector3d& tip, const AxisPositions& axes,
                const Setting& setting) {
    const ToolMotion motion = nominal_motion(machine, axes, setting);
    for (const Joint& joint : machine.joints) {
      if (joint.rotary) continue;
      columns.conservativeResize(3, columns.cols() + 1);
      columns.col(columns.cols() - 1) = motion.axes[joint.axis].v;
      names.push_back(joint.axis);
    }
    left = tip - motion.tool.t;
  }
  /// Moves them to where the tip is nearest; the distance that is left.
  double solve(AxisPositions& axes) const {
    if (names.empty()) return left.norm();
    const Eigen::VectorXd step =
        linear::pivoted_least_squares(Eigen::MatrixXd(columns), Eigen::VectorXd(left));
    for (std::size_t i = 0; i < names.size(); ++i)
      axes[names[i]] += step[static_cast<Eigen::Index>(i)];
    return (left - columns * step).norm();
  }
  Columns columns{3, 0};
  std::vector<std::size_t> names;
  Vector3d left;
};

/// If two linear axes leave the tip off their plane, an axis that is free may put it there: the
/// zeros of the distance over one turn.
std::vector<double> free_positions(const Compiled& machine, const Vector3d& tip,
                                   const RotarySolution& solution, const Setting& setting) {
  AxisPositions axes = solution.axes;
  const auto distance = [&](double position) {
    axes[*solution.free] = position;
    const LinearProblem problem(machine, tip, axes, setting);
    const Vector3d x = problem.columns.col(0), y = problem.columns.col(1);
    return x.cross(y).dot(problem.left);
  };
  constexpr int steps = 180;
  std::vector<double> zeros;
  const double from = solution.axes[*solution.free] - two_pi / 2.0;
  double low = from, at_low = distance(low);
  for (int i = 1; i <= steps; ++i) {
    double a = low, at_a = at_low;
    low = from + two_pi * i / steps;
    at_low = distance(low);
    if ((at_a > 0.0) == (at_low > 0.0)) continue;
    double b = low;
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (a + b), at_middle = distance(middle);
      if ((at_middle > 0.0) == (at_a > 0.0))
        a = middle, at_a = at_middle;
      else
        b = middle;
    }
    zeros.push_back(0.5 * (a + b));
  }
  return zeros;
}

/// The positions of an axis that are whole turns from `position` and within its limits; without
/// limits on a side the one nearest to `near`.
std::vector<double> turns_of(const MachineAxis& axis, double position, double near) {
  const double nearest = position + two_pi * std::round((near - position) / two_pi);
  if (!std::isfinite(axis.low) || !std::isfinite(axis.high)) {
    if (within(axis, nearest)) return {nearest};
    const double end = std::isfinite(axis.low) ? axis.low : axis.high;
    const double turns = (end - position) / two_pi;
    return {position + two_pi * (std::isfinite(axis.low) ? std::ceil(turns) : std::floor(turns))};
  }
  std::vector<double> all;
  const double slack = limit_slack(axis);
  for (double k = std::ceil((axis.low - slack - position) / two_pi);
       position + two_pi * k <= axis.high + slack; ++k)
    all.push_back(position + two_pi * k);
  return all;
}

/// Every combination of turns of the rotary axes.
std::vector<AxisPositions> with_turns(const Machine& machine, const AxisPositions& axes,
                                      const AxisPositions& near) {
  std::vector<AxisPositions> all{axes};
  for (const MachineAxis& axis : machine.axes) {
    if (!is_rotary(axis.name)) continue;
    const std::size_t k = index_of(axis.name);
    std::vector<AxisPositions> more;
    for (const AxisPositions& one : all) {
      for (const double position : turns_of(axis, one[k], near[k])) {
        more.push_back(one);
        more.back()[k] = position;
      }
    }
    all = std::move(more);
  }
  return all;
}

double rotary_distance(const AxisPositions& a, const AxisPositions& b) {
  double sum = 0.0;
  for (std::size_t k = index_of(AxisName::A); k < axis_count; ++k)
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// Candidates that reach tip and direction, limits of linear axes not asked yet.
std::vector<AxisPositions> candidates(const Compiled& machine, const ToolTarget& target,
                                      const AxisPositions& near, const Setting& setting,
                                      std::string& why_none) {
  const Vector3d direction =
      rigid::eigen(setting.bed_from_program.rotation) * rigid::eigen(target.direction);
  const Vector3d tip = rigid::eigen(target.tip_mm);
  const auto rotary = rotary_solutions(machine, direction, near);
  if (rotary.empty()) why_none = "no position of the rotary axes gives the tool this direction";
  std::vector<AxisPositions> all;
  for (const RotarySolution& one : rotary) {
    std::vector<RotarySolution> chosen{one};
    if (one.free && machine.machine.linear_count() == 2) {
      chosen.clear();
      for (const double position : free_positions(machine, tip, one, setting)) {
        chosen.push_back(one);
        chosen.back().axes[*one.free] = position;
      }
    }
    for (const RotarySolution& solution : chosen) {
      AxisPositions axes = solution.axes;
      if (LinearProblem(machine, tip, axes, setting).solve(axes) > reached_mm) continue;
      for (const AxisPositions& turned : with_turns(machine.machine, axes, near))
        all.push_back(turned);
    }
  }
  if (all.empty() && why_none.empty()) why_none = "the axes cannot put the tip there";
  return all;
}

}  // namespace

InverseKinematics axes_for(const MachineModel& model, const ToolTarget& target,
                           const AxisPositions& near, const Setting& setting) {
  InverseKinematics result;
  for (const AxisPositions& axes :
       candidates(model.compiled(), target, near, setting, result.why_none)) {
    const std::string outside = outside_limits(model.machine(), axes);
    if (outside.empty())
      result.solutions.push_back(axes);
    else if (result.why_none.empty())
      result.why_none = outside;
  }
  if (!result.solutions.empty()) result.why_none.clear();
  std::ranges::stable_sort(result.solutions, {},
                           [&](const AxisPositions& axes) { return rotary_distance(axes, near); });
  return result;
}

std::optional<AxisPositions> axes_for_tip(const MachineModel& model, const Vector3& tip_mm,
                                          const AxisPositions& axes, const Setting& setting) {
  AxisPositions out = axes;
  const LinearProblem problem(model.compiled(), rigid::eigen(tip_mm), axes, setting);
  if (problem.names.size() != 3 || std::abs(problem.columns.leftCols<3>().determinant()) < 1e-6)
    return std::nullopt;
  problem.solve(out);
  return out;
}

}  // namespace trueaxis
