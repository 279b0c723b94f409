// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "support/dense.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis::testing {

/// The residual of displacements after the nearest one of a rigid body, by singular values of all
/// rows together.
inline std::vector<Eigen::Vector3d> without_rigid_body(const std::vector<Vector3>& points,
                                                       const std::vector<Vector3>& displacements) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd columns(3 * n, 6);
  Eigen::VectorXd values(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3& p = points[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < 3; ++k) {
      values[3 * i + k] = displacements[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      for (Eigen::Index j = 0; j < 3; ++j) {
        columns(3 * i + k, j) = j == k ? 1.0 : 0.0;
        const Eigen::Vector3d turned =
            Eigen::Vector3d::Unit(j).cross(Eigen::Vector3d(p[0], p[1], p[2])) / 100.0;
        columns(3 * i + k, 3 + j) = turned[k];
      }
    }
  }
  const Eigen::VectorXd left = dense::residuals(columns, values);
  std::vector<Eigen::Vector3d> out;
  for (Eigen::Index i = 0; i < n; ++i) out.push_back(left.segment<3>(3 * i));
  return out;
}

inline double largest_norm(const std::vector<Eigen::Vector3d>& vectors) {
  double most = 0.0;
  for (const Eigen::Vector3d& one : vectors) most = std::max(most, one.norm());
  return most;
}

}  // namespace trueaxis::testing
