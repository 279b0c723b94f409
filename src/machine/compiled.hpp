// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "machine/algebra.hpp"
#include "trueaxis/machine.hpp"

/// The chain read from the workpiece to the tool. A joint there is the tool's side against the
/// workpiece's, so that a part carried by an axis counts inverted:
///
///     tool in part = (W0 D)⁻¹ · P₁ · P₂ … Pₙ · S · Tr(tip)       (product of exponentials)
///
/// with P = A for an axis of the tool and A⁻¹ for one of the workpiece. Each has the motion along
/// or about the axis and the motion of its component errors Ê = Tr(r) E^± Tr(−r), in the order that
/// the inversion leaves. Errors come first for a linear axis of the workpiece and a rotary one of
/// the tool.
namespace trueaxis {

struct Joint {
  struct Component {
    std::size_t direction = 0;  ///< as of ErrorName
    ErrorFunction function;
  };
  std::size_t axis = 0;
  bool rotary = false;
  bool errors_first = false;
  bool inverted = false;  ///< Ê is E⁻¹: for the workpiece, given as the carriage's own deviation
  bool turns = false;     ///< some component is an angle
  Eigen::Vector3d direction, point;  ///< nominal line
  Eigen::Vector3d shift, tilt;       ///< location errors: of the point; of the direction
  double offset = 0.0;               ///< of the position: δ
  Eigen::Vector3d actual_direction, actual_point;
  Eigen::Vector3d pivot, actual_pivot;  ///< of the component errors
  std::vector<Component> components;

  double position(const AxisPositions& axes) const { return axes[axis]; }

  /// `frame` moved along, or turned about, a line by `amount`.
  static rigid::Motion moved(const rigid::Motion& frame, bool rotary,
                             const Eigen::Vector3d& direction, const Eigen::Vector3d& point,
                             double amount) {
    if (!rotary) return {frame.R, frame.t + frame.R * (amount * direction)};
    return frame * rigid::about(point, rigid::turn(direction, amount));
  }
  rigid::Motion nominal(const rigid::Motion& frame, double position) const {
    return moved(frame, rotary, direction, point, position);
  }
  rigid::Motion actual(const rigid::Motion& frame, double position) const {
    return moved(frame, rotary, actual_direction, actual_point, position + offset);
  }
};

struct MachineModel::Compiled {
  Machine machine;
  ErrorModel errors;
  std::vector<Joint> joints;  ///< from the workpiece to the tool
  Eigen::Vector3d gauge_point, tool_direction;
  rigid::Motion spindle;                                                         ///< S
  rigid::Motion workpiece;                                                       ///< D
  Eigen::Vector3d spindle_shift, spindle_turn, workpiece_shift, workpiece_turn;  ///< first order

  ToolPose pose(const rigid::Motion& tool) const {
    return {rigid::array(tool.t), rigid::array(Eigen::Vector3d(tool.R * tool_direction)),
            rigid::rows(tool.R)};
  }

  Eigen::Vector3d tip(const Setting& setting) const {
    return gauge_point - setting.tool_length_mm * tool_direction;
  }
};

}  // namespace trueaxis
