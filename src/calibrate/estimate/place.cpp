// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/place.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d mean(std::span<const Sight> sights) {
  Vector3d sum = Vector3d::Zero();
  for (const Sight& one : sights) sum += one.point;
  return sum / static_cast<double>(sights.size());
}

/// Gauss-Newton on the lengths; returns the sum of squares.
double refine(std::span<const Sight> sights, Vector3d& centre) {
  double square = 0.0;
  for (int step = 0; step < 20; ++step) {
    Matrix3d normal = 1e-9 * Matrix3d::Identity();
    Vector3d right = Vector3d::Zero();
    square = 0.0;
    for (const Sight& one : sights) {
      const Vector3d apart = centre - one.point, g = apart.normalized();
      const double r = one.length_mm - apart.norm();
      normal += g * g.transpose();
      right += g * r;
      square += r * r;
    }
    const Vector3d move = linear::solve_normal(normal, right);
    centre += move;
    if (move.norm() < 1e-10) break;
  }
  return square;
}

// |c − x|² = L²: linear in c − m and |c − m|² once x is taken from its mean m (Eq. 173).
Vector3d trilaterate(std::span<const Sight> sights) {
  const Vector3d m = mean(sights);
  const auto n = static_cast<Index>(sights.size());
  MatrixXd left(n, 3);
  VectorXd right(n);
  double mean_square = 0.0;
  for (Index i = 0; i < n; ++i) {
    const Sight& one = sights[static_cast<std::size_t>(i)];
    left.row(i) = 2.0 * (one.point - m).transpose();
    right[i] = (one.point - m).squaredNorm() - one.length_mm * one.length_mm;
    mean_square -= right[i] / static_cast<double>(n);
  }
  right.array() += mean_square;
  const linear::SingularSystem system = linear::singular_system(left, right, 1e-3);
  const Vector3d flat = system.x;
  if (system.rank == 3) {
    Vector3d centre = m + flat;
    refine(sights, centre);
    return centre;
  }
  Vector3d normal = system.right.col(2);
  if (normal[2] < 0.0) normal = -normal;
  const double height = std::sqrt(std::max(0.0, mean_square - flat.squaredNorm()));
  Vector3d above = m + flat + height * normal, below = m + flat - height * normal;
  const double up = refine(sights, above), down = refine(sights, below);
  return up <= down * (1.0 + 1e-6) ? above : below;
}

}  // namespace

Vector3d place_ball(std::span<const Sight> sights) {
  return sights.front().length_mm > 0.0 ? trilaterate(sights) : mean(sights);
}

Vector3d place_line(std::span<const Sight> sights, Target& target) {
  const Vector3d centre = mean(sights);
  double along = 0.0;
  for (const Sight& one : sights) along += one.along_mm / static_cast<double>(sights.size());
  Vector3d direction = Vector3d::Zero();
  for (const Sight& one : sights) direction += (one.along_mm - along) * (one.point - centre);
  target.direction = direction.normalized();
  Index least = 0;
  target.direction.cwiseAbs().minCoeff(&least);
  target.across[0] = target.direction.cross(Vector3d::Unit(least)).normalized();
  target.across[1] = target.direction.cross(target.across[0]);
  return centre - along * target.direction;
}

}  // namespace trueaxis::calibrate_detail
