// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "trueaxis/association.hpp"

namespace trueaxis {

/// What is associated inside: lines and circles of the plane and of space are problems of their
/// own. A tube is all points at one distance from a line or circle of space.
enum class Shape { line_2d, circle_2d, line_3d, circle_3d, plane, sphere, cylinder, cone, torus };

inline constexpr std::size_t most_parameters = 7;
using Parameters = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_parameters, 1>;
using ParameterMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_parameters, most_parameters>;

/// What a column of the Jacobian is (Eq. 243): a motion of the element in its own frame, a tilt of
/// its axis, a size. Tilts are about the origin of the frame; α moves the axis towards e₁.
enum class Motion { shift_1, shift_2, shift_3, tilt_1, tilt_2, size, second_size };

struct ShapeTraits {
  std::array<Motion, most_parameters> motions{};
  std::size_t parameters = 0;
  std::size_t residuals = 1;  ///< components of the distance: 2 for a line or circle in space
};
const ShapeTraits& traits_of(Shape shape);

/// An element in its place: frame with origin base + offset (apart, so that no digits are lost far
/// from zero) and rows e₁, e₂, e₃ = axis or normal. A line of the plane has its normal as e₁.
struct Placed {
  Shape shape = Shape::plane;
  Point3 base{};
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// Radius; of a cone its orthogonal distance from the origin of the frame (Eq. 242).
  double size = 0.0;
  double second_size = 0.0;  ///< half angle of a cone, minor radius of a torus
};

/// A frame whose third axis is `direction`.
Eigen::Matrix3d axes_about(const Eigen::Vector3d& direction);

/// `placed` moved by a step in the motions of its shape, its frame turned with it.
Placed moved(const Placed& placed, const Parameters& step);

/// Its origin on the axis or in the plane moved to where it is nearest to base + `near`.
Placed recentred(const Placed& placed, const Eigen::Vector3d& near);

}  // namespace trueaxis
