// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "machine/held_axes.hpp"
#include "machine/screw.hpp"

namespace trueaxis {

using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// The y with |yᵢ| ≤ bound_i (infinite: none) that makes |M y + c| least, and of those the one with
/// the least |y|. The problem is convex: where the free minimum is outside, every choice of
/// variables on their bounds is tried and the least that stays within is the answer.
SmallVector bounded_least_squares(const SmallMatrix& M, const Eigen::Vector3d& c,
                                  const SmallVector& bound);

/// The linear problem of a correction: what the axes do to the tool, from a Jacobian.
class CorrectionStep {
 public:
  CorrectionStep(const MachineModel::Compiled& machine, const ToolMotion& motion,
                 const HeldAxes& held);

  /// The residual of a tool: the tip's in mm, and the part of the difference of the directions that
  /// lies across the target's.
  struct Left {
    Eigen::Vector3d tip, direction;
  };

  /// The total change of the axes from where they were commanded, given the `change` so far and the
  /// residual with it. Linear axes that span space make the tip exact. The rotary ones that are not
  /// held make the error of the direction least, each within `largest_rad` of where it was
  /// commanded; of several such the one with the least rotary change. At a pole they turn the
  /// direction by less than a twentieth of their own turn. The part of the error that only this
  /// turn would correct then counts by (20 σ)². Their change therefore falls off to nothing at the
  /// pole with what it gains. With fewer linear axes the tip alone is looked at, of several the
  /// least change in mm and degrees.
  AxisPositions total(const AxisPositions& change, const Left& left, double largest_rad) const;

  /// Whether some error of direction is not worth its correction: near a pole.
  bool near_pole() const { return near_pole_; }
  /// Whether rotary axes correct the direction.
  bool turns() const { return rotary_.count > 0; }

 private:
  AxisPositions by_rotary(const AxisPositions& change, const Left& left, double largest_rad) const;
  AxisPositions of_tip(const AxisPositions& change, const Left& left, double largest_rad) const;
  void weigh();

  struct Column {
    std::size_t axis = 0;
    Eigen::Vector3d tip, direction;
  };
  struct Columns {
    std::array<Column, 3> all;
    std::size_t count = 0;
    void add(const Column& column) { all[count++] = column; }
  };
  Columns linear_, rotary_;
  bool spans_ = false, near_pole_ = false;
  Eigen::Matrix3d tip_inverse_;
  Eigen::Matrix3d by_tip_;  ///< direction that the linear axes turn as the tip moves with them
  SmallMatrix turning_;     ///< direction by the rotary axes, the tip held
  Eigen::Matrix3d worth_;   ///< near a pole: the part of an error of direction that is corrected
};

}  // namespace trueaxis
