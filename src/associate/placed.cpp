// SPDX-License-Identifier: Apache-2.0
#include "associate/placed.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace trueaxis {
namespace {

using enum Motion;

constexpr ShapeTraits all_traits[] = {
    {{shift_1, tilt_1}, 2},                                              // line_2d
    {{shift_1, shift_2, size}, 3},                                       // circle_2d
    {{shift_1, shift_2, tilt_1, tilt_2}, 4, 2},                          // line_3d
    {{shift_1, shift_2, shift_3, tilt_1, tilt_2, size}, 6, 2},           // circle_3d
    {{shift_3, tilt_1, tilt_2}, 3},                                      // plane
    {{shift_1, shift_2, shift_3, size}, 4},                              // sphere
    {{shift_1, shift_2, tilt_1, tilt_2, size}, 5},                       // cylinder
    {{shift_1, shift_2, tilt_1, tilt_2, size, second_size}, 6},          // cone
    {{shift_1, shift_2, shift_3, tilt_1, tilt_2, size, second_size}, 7}  // torus
};

}  // namespace

const ShapeTraits& traits_of(Shape shape) { return all_traits[static_cast<std::size_t>(shape)]; }

Eigen::Matrix3d axes_about(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d e3 = direction.normalized();
  Eigen::Index least = 0;
  e3.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d e1 = Eigen::Vector3d::Unit(least).cross(e3).normalized();
  Eigen::Matrix3d axes;
  axes << e1.transpose(), e3.cross(e1).transpose(), e3.transpose();
  return axes;
}

Placed moved(const Placed& placed, const Parameters& step) {
  Placed out = placed;
  const ShapeTraits& traits = traits_of(placed.shape);
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = shift;
  for (std::size_t k = 0; k < traits.parameters; ++k) {
    const double by = step[static_cast<Eigen::Index>(k)];
    switch (traits.motions[k]) {
      case shift_1:
      case shift_2:
      case shift_3:
        shift[static_cast<Eigen::Index>(traits.motions[k])] = by;
        break;
      case tilt_1:
        turn[1] = by;
        break;
      case tilt_2:
        turn[0] = -by;
        break;
      case size:
        out.size += by;
        break;
      case second_size:
        out.second_size += by;
        break;
    }
  }
  out.offset += placed.axes.transpose() * shift;
  if (const double angle = turn.norm(); angle > 0.0) {
    // Rows of `axes` are the frame's vectors: each is turned, in the frame as it was.
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    out.axes = turned.transpose() * placed.axes;
    out.axes.row(2).normalize();
    out.axes.row(0) -= out.axes.row(0).dot(out.axes.row(2)) * out.axes.row(2);
    out.axes.row(0).normalize();
    out.axes.row(1) = out.axes.row(2).cross(out.axes.row(0));
  }
  return out;
}

Placed recentred(const Placed& placed, const Eigen::Vector3d& near) {
  Placed out = placed;
  const Eigen::Vector3d away = placed.axes * (near - placed.offset);
  switch (placed.shape) {
    case Shape::line_2d:
    case Shape::line_3d:
    case Shape::cylinder:
      out.offset += placed.axes.row(2).transpose() * away[2];
      break;
    case Shape::cone:
      out.offset += placed.axes.row(2).transpose() * away[2];
      out.size += std::sin(placed.second_size) * away[2];
      // The same cone with a half angle below 90°, maybe with −d.
      if (std::cos(out.second_size) < 0.0) out.size = -out.size;
      out.second_size = std::remainder(out.second_size, std::numbers::pi);
      break;
    case Shape::plane:
      out.offset += placed.axes.topRows<2>().transpose() * away.head<2>();
      break;
    default:
      break;
  }
  return out;
}

}  // namespace trueaxis
