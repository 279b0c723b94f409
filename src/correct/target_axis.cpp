// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "trueaxis/correction.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

bool is_plane(const Reference& reference) { return reference.face_radius_mm > 0.0; }

Eigen::Vector3d direction(const Axis& axis) {
  return Eigen::Vector3d(axis.slope_x, axis.slope_y, 1.0).normalized();
}

/// Perpendicular distance of the point of `axis` at z from the line `datum`, mm.
double distance_mm(const Axis& axis, const Axis& datum, double z_mm) {
  const auto [x, y] = axis.at(z_mm);
  const auto [x_datum, y_datum] = datum.at(z_mm);
  return Eigen::Vector3d(x - x_datum, y - y_datum, 0.0).cross(direction(datum)).norm();
}

double tilt_between_rad(const Axis& a, const Axis& b) {
  const Eigen::Vector3d u = direction(a), v = direction(b);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// What each reference counts in the mean position at mid length and in the mean direction.
struct Shares {
  std::vector<double> position, direction;
};

// With a_i the distance at mid length and b_i that of the slopes, over the length L:
//   ∫ |a_i + b_i (Z − Z_mid)|² dZ = L (a_i² + b_i² L²/12),   a plane: L R² b_j²,
// so position and direction separate, and the minimum is a weighted mean of each.
Shares shares_of(std::span<const Reference> references, double length_mm, bool needs_position) {
  Shares shares;
  double position = 0.0, direction = 0.0;
  const bool any_plane = std::any_of(references.begin(), references.end(), is_plane);
  for (const Reference& reference : references) {
    const bool plane = is_plane(reference);
    // Without planes L cancels: its limit L → 0 then serves like any length.
    const double arm = plane ? reference.face_radius_mm * reference.face_radius_mm
                             : (any_plane ? length_mm * length_mm / 12.0 : 1.0);
    shares.position.push_back(plane ? 0.0 : reference.weight);
    shares.direction.push_back(reference.weight * arm);
    position += shares.position.back();
    direction += shares.direction.back();
  }
  if (!(position > 0.0) && needs_position) {
    throw Refusal(
        "the references do not fix the position of the target axis: planes give its direction "
        "only. Add a "
        "cylinder or cone with a weight above 0.");
  }
  for (double& share : shares.position) share /= position > 0.0 ? position : 1.0;
  for (double& share : shares.direction) share /= direction;
  return shares;
}

/// ∂(x, y, slope_x, slope_y of the target at z_mid) / ∂(those of a reference at its own z_ref).
Matrix4 jacobian(const Axis& reference, double z_mid_mm, double position, double direction_share) {
  Matrix4 j = Matrix4::Zero();
  j.topLeftCorner<2, 2>() = Eigen::Matrix2d::Identity() * position;
  j.topRightCorner<2, 2>() =
      Eigen::Matrix2d::Identity() * (position * (z_mid_mm - reference.z_ref_mm));
  j.bottomRightCorner<2, 2>() = Eigen::Matrix2d::Identity() * direction_share;
  return j;
}

Remainder remainder(const Reference& reference, const Axis& target, double z_start_mm,
                    double z_end_mm) {
  Remainder left;
  left.name = reference.name;
  left.tilt_rad = tilt_between_rad(target, reference.axis.axis);
  if (is_plane(reference)) {
    const double diameter = 2.0 * reference.face_radius_mm;
    left.coaxiality_mm = diameter * std::tan(left.tilt_rad);
    left.u_coaxiality_mm = diameter * reference.axis.u_slope();
    return left;
  }
  left.offset_start_mm = distance_mm(target, reference.axis.axis, z_start_mm);
  left.offset_end_mm = distance_mm(target, reference.axis.axis, z_end_mm);
  left.coaxiality_mm = coaxiality_mm(target, reference.axis.axis, z_start_mm, z_end_mm);
  left.u_coaxiality_mm =
      2.0 * std::max(reference.axis.u_at(z_start_mm), reference.axis.u_at(z_end_mm));
  return left;
}

}  // namespace

TargetAxis solve_target_axis(std::span<const Reference> references, double z_start_mm,
                             double z_end_mm, bool needs_position) {
  for (const Reference& reference : references) {
    expects(std::isfinite(reference.weight) && reference.weight >= 0.0, "weights of 0 or more");
    expects(reference.face_radius_mm >= 0.0, "face radii of 0 or more");
  }
  expects(std::isfinite(z_start_mm) && std::isfinite(z_end_mm), "finite ends of the cut");
  const double z_mid = 0.5 * (z_start_mm + z_end_mm);
  const Shares shares = shares_of(references, std::abs(z_end_mm - z_start_mm), needs_position);

  TargetAxis target;
  Axis& axis = target.axis.axis;
  axis.z_ref_mm = z_mid;
  Matrix4 covariance = Matrix4::Zero();
  for (std::size_t i = 0; i < references.size(); ++i) {
    const AxisEstimate& reference = references[i].axis;
    const auto [x, y] = reference.axis.at(z_mid);
    axis.x_mm += shares.position[i] * x;
    axis.y_mm += shares.position[i] * y;
    axis.slope_x += shares.direction[i] * reference.axis.slope_x;
    axis.slope_y += shares.direction[i] * reference.axis.slope_y;
    const Matrix4 j = jacobian(reference.axis, z_mid, shares.position[i], shares.direction[i]);
    covariance += j * Eigen::Map<const Matrix4>(reference.covariance.data()) * j.transpose();
  }
  Eigen::Map<Matrix4>(target.axis.covariance.data()) = covariance;
  target.remainders = remainders_of(references, axis, z_start_mm, z_end_mm);
  return target;
}

std::vector<Remainder> remainders_of(std::span<const Reference> references, const Axis& target,
                                     double z_start_mm, double z_end_mm) {
  std::vector<Remainder> list;
  for (const Reference& reference : references)
    list.push_back(remainder(reference, target, z_start_mm, z_end_mm));
  return list;
}

// The distance from a line is convex along another line: its maximum is at an end.
double coaxiality_mm(const Axis& toleranced, const Axis& datum, double z_start_mm,
                     double z_end_mm) {
  return 2.0 * std::max(distance_mm(toleranced, datum, z_start_mm),
                        distance_mm(toleranced, datum, z_end_mm));
}

}  // namespace trueaxis
