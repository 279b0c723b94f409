// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "form/surface_sums.hpp"

namespace trueaxis::form {

/// How an order's size may run along Z: variances of its degrees over that of the first. The first
/// of these is an order that is the same at every Z. Eq. 319.
std::vector<Eigen::VectorXd> courses_along_z(int first_degree, int degrees);

/// One order of a surface, a Gaussian process along Z: h_n = τ Σ_d √w_d f_d z_d, z normal. The
/// course w and the size τ are those of a list, by their evidence. Eq. 320.
class SurfaceOrder {
 public:
  /// @param normal AᵀA of the order's own columns
  SurfaceOrder(int order, int first_degree, int degrees, Eigen::Index column,
               Eigen::MatrixXd normal);

  int order() const { return order_; }
  Eigen::Index column() const { return column_; }
  Eigen::Index size() const { return normal_.rows(); }
  const Eigen::MatrixXd& normal() const { return normal_; }
  std::size_t courses() const { return weights_.size(); }
  bool first_is_constant() const { return first_degree_ == 0; }

  /// ln of the density of Aᵀy with each course and size over that without the order: a row a
  /// course. @param right Aᵀy of the order's columns without all else
  void evidence(const Eigen::VectorXd& right, double variance, const std::vector<double>& sizes,
                Eigen::MatrixXd& out) const;

  /// The coefficients by a course and a size (τ²) and as many normal numbers as `size()`.
  Eigen::VectorXd draw(const Eigen::VectorXd& right, double variance, std::size_t course,
                       double size, const Eigen::VectorXd& normal_numbers) const;

 private:
  /// √w AᵀA √w = V diag(λ) Vᵀ, of the columns whose w is not 0.
  struct System {
    Eigen::VectorXd values;
    Eigen::MatrixXd back;  ///< √w V: from coordinates to coefficients; its transpose the other way
  };
  const System& system(std::size_t course) const;

  int order_, first_degree_;
  Eigen::Index column_;
  Eigen::MatrixXd normal_;
  std::vector<Eigen::VectorXd> weights_;  ///< of the columns
  mutable std::vector<std::optional<System>> systems_;
};

}  // namespace trueaxis::form
