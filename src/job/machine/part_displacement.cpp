// SPDX-License-Identifier: Apache-2.0
#include "job/machine/part_displacement.hpp"

#include <algorithm>

#include "math/linear_algebra.hpp"

namespace trueaxis::machine_job {
namespace {

constexpr double least_shown = 1e-9;  // of the largest eigenvalue: turns that points do not show

/// Displacement of a point by shift and turn · reach.
Eigen::Matrix<double, 3, 6> columns_at(const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> columns;
  columns << 1, 0, 0, 0, arm[2], -arm[1],  //
      0, 1, 0, -arm[2], 0, arm[0],         //
      0, 0, 1, arm[1], -arm[0], 0;
  return columns;
}

}  // namespace

RigidFit::RigidFit(std::span<const Eigen::Vector3d> points_mm)
    : points_mm_(points_mm.begin(), points_mm.end()) {
  for (const Eigen::Vector3d& point : points_mm_) middle_mm_ += point;
  if (!points_mm_.empty()) middle_mm_ /= static_cast<double>(points_mm_.size());
  double most = 0.0;
  for (const Eigen::Vector3d& point : points_mm_)
    most = std::max(most, (point - middle_mm_).norm());
  if (most > 0.0) reach_mm_ = most;
  for (const Eigen::Vector3d& point : points_mm_) {
    const auto columns = columns_at((point - middle_mm_) / reach_mm_);
    normal_ += columns.transpose() * columns;
  }
}

RigidFit::Body RigidFit::nearest(const Displacements& displacements_mm) const {
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < points_mm_.size(); ++i)
    right += columns_at((points_mm_[i] - middle_mm_) / reach_mm_).transpose() * displacements_mm[i];
  const Eigen::Matrix<double, 6, 1> found =
      linear::least_squares(normal_, Eigen::VectorXd(right), least_shown);
  return {middle_mm_, found.head<3>(), found.tail<3>() / reach_mm_};
}

Eigen::MatrixXd RigidFit::Sums::bodies() const {
  return linear::least_squares(fit_.normal_, right_, least_shown);
}

void RigidFit::Sums::add(const Eigen::Vector3d& point_mm,
                         const Eigen::Matrix3Xd& displacements_mm) {
  right_ +=
      columns_at((point_mm - fit_.middle_mm_) / fit_.reach_mm_).transpose() * displacements_mm;
}

Eigen::Matrix3Xd RigidFit::at(const Eigen::Vector3d& point_mm,
                              const Eigen::MatrixXd& bodies) const {
  return columns_at((point_mm - middle_mm_) / reach_mm_) * bodies;
}

Displacements RigidFit::without(const Displacements& displacements_mm, const Body& body) const {
  Displacements left = displacements_mm;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= body.at(points_mm_[i]);
  return left;
}

}  // namespace trueaxis::machine_job
