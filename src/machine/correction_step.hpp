// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "machine/screw.hpp"

namespace trueaxis {

/// The linear problem of a correction: what the axes do to the tool, from a Jacobian.
class CorrectionStep {
 public:
  CorrectionStep(const MachineModel::Compiled& machine, const ToolMotion& motion);

  /// What is left of a tool: of its tip in mm, of its direction as the part of the difference that
  /// lies across the target's.
  struct Left {
    Eigen::Vector3d tip, direction;
  };

  /// The total change of the axes from where they were commanded, given the `change` so far and
  /// what is left with it. With linear axes that span space the tip is exact by them and the rotary
  /// ones make the direction least, each within `largest_rad` of where it was commanded; of several
  /// such the one with the least rotary change. With fewer linear axes the tip alone is looked at,
  /// of several the least change in mm and degrees.
  AxisPositions total(const AxisPositions& change, const Left& left, double largest_rad) const;

  /// The rotary axis that turns the tool's direction least: the one that a pole leaves without
  /// effect.
  std::size_t weakest_rotary() const;

 private:
  AxisPositions by_rotary(const AxisPositions& change, const Left& left, double largest_rad) const;
  AxisPositions of_tip(const AxisPositions& change, const Left& left, double largest_rad) const;

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
  bool spans_ = false;
  Eigen::Matrix3d tip_inverse_;
};

}  // namespace trueaxis
