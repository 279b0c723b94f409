// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "trueaxis/machine.hpp"

/// Rigid motions with Eigen's small fixed types, which stay inside.
namespace trueaxis::rigid {

inline Eigen::Vector3d eigen(const Vector3& v) { return {v[0], v[1], v[2]}; }
inline Vector3 array(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

inline Eigen::Matrix3d eigen(const Matrix3& m) {
  Eigen::Matrix3d out;
  for (int row = 0; row < 3; ++row)
    out.row(row) = eigen(m[static_cast<std::size_t>(row)]).transpose();
  return out;
}
inline Matrix3 rows(const Eigen::Matrix3d& m) {
  Matrix3 out;
  for (int row = 0; row < 3; ++row)
    out[static_cast<std::size_t>(row)] = {m(row, 0), m(row, 1), m(row, 2)};
  return out;
}

/// x_to = R x_from + t.
struct Motion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const { return R * x + t; }
  Motion operator*(const Motion& right) const { return {R * right.R, R * right.t + t}; }
  Motion inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
};

inline Motion motion(const RigidTransform& transform) {
  return {eigen(transform.rotation), eigen(transform.origin_mm)};
}

/// a I + b [v]× + c v vᵀ.
inline Eigen::Matrix3d combined(const Eigen::Vector3d& v, double a, double b, double c) {
  const double x = b * v[0], y = b * v[1], z = b * v[2];
  const Eigen::Vector3d w = c * v;
  Eigen::Matrix3d out;
  out << a + w[0] * v[0], w[0] * v[1] - z, w[0] * v[2] + y,  //
      w[1] * v[0] + z, a + w[1] * v[1], w[1] * v[2] - x,     //
      w[2] * v[0] - y, w[2] * v[1] + x, a + w[2] * v[2];
  return out;
}

/// Turns by `angle_rad` about the unit vector `axis` (Rodrigues' formula).
inline Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double angle_rad) {
  const double c = std::cos(0.5 * angle_rad), s = std::sin(0.5 * angle_rad);
  const double versine = 2.0 * s * s;
  return combined(axis, 1.0 - versine, 2.0 * s * c, versine);
}

/// exp(w): turns by |w| about w. Below 0.01 rad by the series, whose next term is below 2e-16.
inline Eigen::Matrix3d exponential(const Eigen::Vector3d& w) {
  const double square = w.squaredNorm();
  if (square < 1e-4) {
    const double sine = 1.0 - square / 6.0 * (1.0 - square / 20.0);
    const double versine = 0.5 - square / 24.0 * (1.0 - square / 30.0);
    return combined(w, 1.0 - square * versine, sine, versine);
  }
  const double angle_rad = std::sqrt(square);
  return turn(w / angle_rad, angle_rad);
}

/// Turns by `R` about `point`, then moves by `shift`.
inline Motion about(const Eigen::Vector3d& point, const Eigen::Matrix3d& R,
                    const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  return {R, point + shift - R * point};
}

/// w with exp(w) = R, |w| ≤ π.
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  return (sine > 0.0 ? 2.0 * std::atan2(sine, q.w()) / sine : 2.0) * q.vec();
}

}  // namespace trueaxis::rigid
