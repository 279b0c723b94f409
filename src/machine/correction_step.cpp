// SPDX-License-Identifier: Apache-2.0
#include "machine/correction_step.hpp"

#include <Eigen/LU>
#include <cmath>

#include "machine/bounded_least_squares.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double spanning = 1e-3;  ///< volume of the linear axes' directions that spans space

}  // namespace

CorrectionStep::CorrectionStep(const MachineModel::Compiled& machine, const ToolMotion& motion) {
  const Vector3d direction = motion.direction(machine);
  for (const Joint& joint : machine.joints) {
    const Screw& screw = motion.axes[joint.axis];
    Columns& columns = joint.rotary ? rotary_ : linear_;
    columns.add({joint.axis, screw.of_point(motion.tool.t), screw.w.cross(direction)});
  }
  if (linear_.count != 3) return;
  Eigen::Matrix3d tip;
  tip << linear_.all[0].tip, linear_.all[1].tip, linear_.all[2].tip;
  spans_ = std::abs(tip.determinant()) > spanning;
  if (spans_) tip_inverse_ = tip.inverse();
}

std::size_t CorrectionStep::weakest_rotary() const {
  std::size_t weakest = 0;
  for (std::size_t i = 1; i < rotary_.count; ++i)
    if (rotary_.all[i].direction.norm() < rotary_.all[weakest].direction.norm()) weakest = i;
  return rotary_.all[weakest].axis;
}

AxisPositions CorrectionStep::total(const AxisPositions& change, const Left& left,
                                    double largest_rad) const {
  return spans_ ? by_rotary(change, left, largest_rad) : of_tip(change, left, largest_rad);
}

AxisPositions CorrectionStep::by_rotary(const AxisPositions& change, const Left& left,
                                        double largest_rad) const {
  // The linear axes take the tip along: their turning the tool is what their errors do.
  Eigen::Matrix3d turning;
  turning << linear_.all[0].direction, linear_.all[1].direction, linear_.all[2].direction;
  const Eigen::Matrix3d by_tip = turning * tip_inverse_;
  const auto n = static_cast<Index>(rotary_.count);
  SmallMatrix M(3, n);
  Vector3d c = left.direction - by_tip * left.tip;
  for (Index i = 0; i < n; ++i) {
    const Column& column = rotary_.all[static_cast<std::size_t>(i)];
    M.col(i) = column.direction - by_tip * column.tip;
    c -= change[column.axis] * M.col(i);
  }
  const SmallVector y = bounded_least_squares(M, c, SmallVector::Constant(n, largest_rad));
  AxisPositions total = change;
  Vector3d tip = left.tip;
  for (Index i = 0; i < n; ++i) {
    const Column& column = rotary_.all[static_cast<std::size_t>(i)];
    tip += (y[i] - change[column.axis]) * column.tip;
    total[column.axis] = y[i];
  }
  const Vector3d step = -(tip_inverse_ * tip);
  for (Index i = 0; i < 3; ++i) total[linear_.all[static_cast<std::size_t>(i)].axis] += step[i];
  return total;
}

AxisPositions CorrectionStep::of_tip(const AxisPositions& change, const Left& left,
                                     double largest_rad) const {
  const auto n = static_cast<Index>(linear_.count + rotary_.count);
  SmallMatrix M(3, n);
  SmallVector bound(n), now(n);
  Index i = 0;
  const auto each = [&](const auto& act) {
    i = 0;
    for (std::size_t k = 0; k < linear_.count; ++k) act(linear_.all[k], 1.0, INFINITY);
    for (std::size_t k = 0; k < rotary_.count; ++k) act(rotary_.all[k], rad_per_deg, largest_rad);
  };
  each([&](const Column& column, double unit, double largest) {
    M.col(i) = unit * column.tip;
    bound[i] = largest / unit;
    now[i++] = change[column.axis] / unit;
  });
  const SmallVector y = bounded_least_squares(M, left.tip - M * now, bound);
  AxisPositions total = change;
  each([&](const Column& column, double unit, double) { total[column.axis] = unit * y[i++]; });
  return total;
}

}  // namespace trueaxis
