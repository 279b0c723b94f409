// SPDX-License-Identifier: Apache-2.0
#include "machine/rotary_solutions.hpp"

#include <cmath>

namespace trueaxis {
namespace {

using Eigen::Vector3d;

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

}  // namespace

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

}  // namespace trueaxis
