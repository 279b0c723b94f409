// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "machine/compiled.hpp"
#include "machine/limits.hpp"
#include "machine/screw.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
using Compiled = MachineModel::Compiled;

/// Positions of the rotary axes that give the tool a direction.
struct RotarySolution {
  AxisPositions axes{};             ///< the linear ones at 0
  std::optional<std::size_t> free;  ///< an axis that may be anywhere: a pole
};

constexpr double same_direction = 1e-6;  ///< of a target that fewer than two rotary axes must meet
constexpr double at_pole = 1e-9;         ///< sine of the angle between a direction and an axis

/// The angle about unit `u` from `from` to `to`, both seen along it.
double angle_about(const Vector3d& u, const Vector3d& from, const Vector3d& to) {
  return std::atan2(u.dot(from.cross(to)), from.dot(to) - u.dot(from) * u.dot(to));
}

bool along(const Vector3d& v, const Vector3d& u) { return v.cross(u).norm() < at_pole; }

struct Chain {
  std::vector<const Joint*> rotary;
  Vector3d tool;

  Vector3d direction(const AxisPositions& axes) const {
    Vector3d v = tool;
    for (auto joint = rotary.rbegin(); joint != rotary.rend(); ++joint)
      v = rigid::turn((*joint)->direction, axes[(*joint)->axis]) * v;
    return v;
  }
};

/// The two cones meet in directions that cancellation leaves 1e-16/γ off: Newton's method takes
/// that away, along the axis that turns the tool more where they turn it alike.
void polish(const Chain& chain, const Joint& first, const Joint& second, const Vector3d& target,
            AxisPositions& axes) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d now = chain.direction(axes), left = target - now;
    const Vector3d a = first.direction.cross(now);
    const Vector3d b =
        (rigid::turn(first.direction, axes[first.axis]) * second.direction).cross(now);
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
    const double det = aa * bb - ab * ab;
    if (det > 1e-12 * bb * bb) {
      axes[first.axis] += (bb * a.dot(left) - ab * b.dot(left)) / det;
      axes[second.axis] += (aa * b.dot(left) - ab * a.dot(left)) / det;
    } else if (bb > 0.0) {
      axes[second.axis] += b.dot(left) / bb;
    }
  }
}

std::vector<RotarySolution> of_one(const Chain& chain, const Vector3d& target,
                                   const AxisPositions& near) {
  const Joint& joint = *chain.rotary.front();
  const Vector3d& u = joint.direction;
  if (std::abs(u.dot(chain.tool) - u.dot(target)) > same_direction) return {};
  RotarySolution solution;
  if (along(chain.tool, u)) {
    solution.free = joint.axis;
    solution.axes[joint.axis] = near[joint.axis];
  } else {
    solution.axes[joint.axis] = angle_about(u, chain.tool, target);
  }
  return {solution};
}

std::vector<RotarySolution> of_two(const Chain& chain, const Joint& first, const Joint& second,
                                   const Vector3d& target, const AxisPositions& start) {
  const Vector3d &u = first.direction, &w = second.direction;
  const Vector3d across = u.cross(w);
  const double c = u.dot(w), ss = across.squaredNorm();
  if (ss < 1e-12) return {};
  const double a = u.dot(target), b = w.dot(chain.tool);
  const double alpha = (a - c * b) / ss, beta = (b - c * a) / ss;
  double gamma = (1.0 - alpha * alpha - beta * beta - 2.0 * alpha * beta * c) / ss;
  if (gamma < -1e-12) return {};
  gamma = std::sqrt(std::max(gamma, 0.0));
  std::vector<RotarySolution> solutions;
  for (const double side : {1.0, -1.0}) {
    const Vector3d between = alpha * u + beta * w + side * gamma * across;
    RotarySolution one{start, {}};
    if (along(chain.tool, w))
      one.free = second.axis;
    else
      one.axes[second.axis] = angle_about(w, chain.tool, between);
    if (along(target, u))
      one.free = first.axis;
    else
      one.axes[first.axis] = angle_about(u, between, target);
    if (!one.free) polish(chain, first, second, target, one.axes);
    solutions.push_back(one);
    if (gamma < 1e-9) break;
  }
  return solutions;
}

/// All of one turn: of the chain exp(q₁ u₁) … exp(qₘ uₘ) t = d with t the tool's direction, d the
/// target's, both in M. Two axes by the intersection of two cones (Paden and Kahan's second
/// subproblem), one by its angle; of three the first stays as `near` has it. Empty: none.
std::vector<RotarySolution> rotary_solutions(const MachineModel::Compiled& machine,
                                             const Vector3d& direction, const AxisPositions& near) {
  Chain chain{{}, machine.tool_direction};
  for (const Joint& joint : machine.joints)
    if (joint.rotary) chain.rotary.push_back(&joint);
  const std::size_t count = chain.rotary.size();
  if (count == 0)
    return chain.tool.cross(direction).norm() < same_direction && chain.tool.dot(direction) > 0.0
               ? std::vector<RotarySolution>(1)
               : std::vector<RotarySolution>();
  if (count == 1) return of_one(chain, direction, near);
  AxisPositions start{};
  for (const Joint* joint : chain.rotary) start[joint->axis] = near[joint->axis];
  if (count == 2) return of_two(chain, *chain.rotary[0], *chain.rotary[1], direction, start);
  const Joint& held = *chain.rotary[0];
  const Eigen::Matrix3d back = rigid::turn(held.direction, -near[held.axis]);
  Chain rest{{chain.rotary[1], chain.rotary[2]}, chain.tool};
  return of_two(rest, *rest.rotary[0], *rest.rotary[1], back * direction, start);
}

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
