// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "machine/algebra.hpp"

namespace trueaxis {
namespace {

/// The unit quaternion of actual · nominalᵀ, with w ≥ 0.
Eigen::Quaterniond difference(const ToolPose& actual, const ToolPose& nominal) {
  Eigen::Quaterniond q(
      Eigen::Matrix3d(rigid::eigen(actual.rotation) * rigid::eigen(nominal.rotation).transpose()));
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

}  // namespace

ToolDisplacement displacement(const ToolPose& actual, const ToolPose& nominal) {
  const Eigen::Quaterniond q = difference(actual, nominal);
  const double sine = q.vec().norm();
  const double factor = sine > 0.0 ? 2.0 * std::atan2(sine, q.w()) / sine : 2.0;
  ToolDisplacement out;
  out.tip_mm =
      rigid::array(Eigen::Vector3d(rigid::eigen(actual.tip_mm) - rigid::eigen(nominal.tip_mm)));
  out.rotation_rad = rigid::array(Eigen::Vector3d(factor * q.vec()));
  return out;
}

double angle_between_rad(const Vector3& a, const Vector3& b) {
  const Eigen::Vector3d u = rigid::eigen(a), v = rigid::eigen(b);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

double about_tool_axis_rad(const ToolPose& actual, const ToolPose& nominal) {
  const Eigen::Quaterniond q = difference(actual, nominal);
  return 2.0 * std::atan2(q.vec().dot(rigid::eigen(nominal.direction)), q.w());
}

}  // namespace trueaxis
