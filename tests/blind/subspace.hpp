// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace trueaxis::blind {

/// The span of columns as an orthonormal basis. A column that the ones before leave less than 1e-7
/// of itself (finite differences carry about 1e-9) adds nothing.
class Subspace {
 public:
  explicit Subspace(Eigen::Index rows) : basis_(rows, 0) {}
  Subspace(const Eigen::MatrixXd& columns) : basis_(columns.rows(), 0) { add(columns); }

  void add(const Eigen::MatrixXd& columns) {
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      const double size = columns.col(j).norm();
      if (!(size > 0.0)) continue;
      Eigen::VectorXd v = residual(columns.col(j) / size);
      if (v.norm() < 1e-7) continue;
      v = residual(v / v.norm());  // twice is enough (Kahan)
      basis_.conservativeResize(Eigen::NoChange, basis_.cols() + 1);
      basis_.col(basis_.cols() - 1) = v / v.norm();
    }
  }

  /// (I − P) v.
  Eigen::VectorXd residual(const Eigen::VectorXd& v) const {
    if (basis_.cols() == 0) return v;
    return v - basis_ * (basis_.transpose() * v);
  }

  Eigen::Index rank() const { return basis_.cols(); }

 private:
  Eigen::MatrixXd basis_;
};

}  // namespace trueaxis::blind
