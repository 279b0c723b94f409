// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "trueaxis/machine_job.hpp"

namespace trueaxis::machine_job {

/// Small displacements of points of the workpiece's body, an entry a point.
using Displacements = std::vector<Eigen::Vector3d>;

/// The displacement of a rigid body that is nearest to the displacements of its points, by least
/// squares (Eq. 220). If the points do not show a turn (one point, a line), there is none.
class RigidFit {
 public:
  explicit RigidFit(std::span<const Eigen::Vector3d> points_mm);

  struct Body {
    Eigen::Vector3d about_mm, shift_mm, turn_rad;
    Eigen::Vector3d at(const Eigen::Vector3d& point_mm) const {
      return shift_mm + turn_rad.cross(point_mm - about_mm);
    }
  };
  Body nearest(const Displacements& displacements_mm) const;
  /// The same of many displacements at once, which come point by point: a column each.
  class Sums {
   public:
    Sums(const RigidFit& fit, Eigen::Index columns)
        : fit_(fit), right_(Eigen::MatrixXd::Zero(6, columns)) {}
    void add(const Eigen::Vector3d& point_mm, const Eigen::Matrix3Xd& displacements_mm);
    Eigen::MatrixXd bodies() const;

   private:
    const RigidFit& fit_;
    Eigen::MatrixXd right_;
  };
  /// Displacement of a point by `Sums::bodies`.
  Eigen::Matrix3Xd at(const Eigen::Vector3d& point_mm, const Eigen::MatrixXd& bodies) const;
  /// The residual of them after it.
  Displacements without(const Displacements& displacements_mm, const Body& body) const;

 private:
  std::vector<Eigen::Vector3d> points_mm_;
  Eigen::Vector3d middle_mm_ = Eigen::Vector3d::Zero();
  double reach_mm_ = 1.0;  ///< of the points about their middle, so that all columns are lengths
  Eigen::Matrix<double, 6, 6> normal_ = Eigen::Matrix<double, 6, 6>::Zero();
};

}  // namespace trueaxis::machine_job
