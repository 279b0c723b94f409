// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "form/surface_sums.hpp"

namespace trueaxis::form {

/// One order of a surface, a Gaussian process along Z: h_n = τ Σ_d √w_d f_d z_d, z normal. The
/// course w and the size τ are those of a list, by their evidence. Eq. 320.
class SurfaceOrder {
 public:
  /// @param normal AᵀA of the order's own columns
  SurfaceOrder(int order, int first_degree, int degrees, Eigen::Index column,
               const Eigen::MatrixXd& normal);
  /// A local form in the place of an order. @param log_tests ln of the places looked at
  SurfaceOrder(Eigen::Index column, const Eigen::MatrixXd& normal, double log_tests);

  /// −1: a local form
  int order() const { return order_; }
  Eigen::Index column() const { return column_; }
  Eigen::Index size() const { return seen_.cols(); }
  Eigen::Index courses() const { return static_cast<Eigen::Index>(begin_.size()) - 1; }
  bool first_is_constant() const { return first_degree_ == 0; }

  /// ln of the density of Aᵀy with each course and size over that without the order: a column a
  /// course. @param right Aᵀy of the order's columns without all else
  /// @param gain τ²/σ² of each size, padded (`sizes_at_once`)
  void evidence(const Eigen::VectorXd& right, double variance, std::span<const double> gain,
                Eigen::MatrixXd& out) const;

  /// The coefficients by a course and a size (τ²) and as many normal numbers as `size()`.
  Eigen::VectorXd draw(const Eigen::VectorXd& right, double variance, Eigen::Index course,
                       double size, const Eigen::VectorXd& normal_numbers) const;

 private:
  Eigen::Index begin(Eigen::Index course) const { return begin_[static_cast<std::size_t>(course)]; }
  void add_course(const Eigen::VectorXd& weight, const Eigen::MatrixXd& normal);

  int order_ = -1, first_degree_ = 1;
  double log_tests_ = 0.0;
  Eigen::Index column_;
  /// √w AᵀA √w = V diag(λ) Vᵀ of each course, of the columns whose w is not 0, one after the other.
  std::vector<Eigen::Index> begin_{0};
  std::vector<double> values_;
  Eigen::MatrixXd seen_;  ///< Vᵀ√w: from Aᵀy to coordinates; its transpose to coefficients
};

}  // namespace trueaxis::form
