// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

// Eigen's products and decompositions of dynamic matrices, compiled once: a room that writes them
// itself compiles them itself, 1 to 5 s each.
namespace trueaxis::linear {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A B.
MatrixXd product(const MatrixXd& a, const MatrixXd& b);
/// AᵀA.
MatrixXd gram(const MatrixXd& a);
/// A Bᵀ.
MatrixXd product_transposed(const MatrixXd& a, const MatrixXd& b);
/// AᵀB and Aᵀb.
MatrixXd transposed_product(const MatrixXd& a, const MatrixXd& b);
VectorXd transposed_product(const MatrixXd& a, const VectorXd& b);
/// A diag(w).
MatrixXd scaled_columns(const MatrixXd& a, const VectorXd& w);
/// diag(w) A.
MatrixXd scaled_rows(const VectorXd& w, const MatrixXd& a);
/// diag(w) A diag(w).
MatrixXd scaled_both(const MatrixXd& a, const VectorXd& w);
/// A C Aᵀ.
MatrixXd propagated(const MatrixXd& a, const MatrixXd& c);

/// Orthonormal columns that span those of A; pivots below `threshold` of the largest count as none
/// (0: rounding).
MatrixXd orthonormal_basis(const MatrixXd& a, double threshold = 0.0);
/// The same with pivots below `least`, in the unit of A, as none.
MatrixXd orthonormal_basis_above(const MatrixXd& a, double least);
/// What orthonormal columns Q leave: B − Q QᵀB.
MatrixXd beside(const MatrixXd& q, const MatrixXd& b);
VectorXd beside(const MatrixXd& q, const VectorXd& b);

/// The x of least |A x − b| with zeros where columns depend on others.
VectorXd pivoted_least_squares(const MatrixXd& a, const VectorXd& b);
MatrixXd pivoted_least_squares(const MatrixXd& a, const MatrixXd& b);
/// The shortest x of least |A x − b|, whatever the rank of A (`threshold`: see orthonormal_basis).
VectorXd least_squares(const MatrixXd& a, const VectorXd& b, double threshold = 0.0);
/// The same, a column of B each.
MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b, double threshold = 0.0);
MatrixXd pseudo_inverse(const MatrixXd& a);
/// Both, and the rank.
struct ShortestSolution {
  VectorXd x;
  MatrixXd pseudo_inverse;
  Eigen::Index rank = 0;
};
ShortestSolution shortest_solution(const MatrixXd& a, const VectorXd& b);

/// N⁻¹ of a symmetric positive definite matrix.
MatrixXd inverse_of_normal(const MatrixXd& n);
/// N⁻¹ b and N⁻¹ B of one, of which the lower triangle is read.
VectorXd solve_normal(const MatrixXd& n, const VectorXd& b);
MatrixXd solve_normal(const MatrixXd& n, const MatrixXd& b);
/// vᵀ N⁻¹ v.
double weighed_square(const VectorXd& v, const MatrixXd& n);
Eigen::Vector3d solve_normal(const Eigen::Matrix3d& n, const Eigen::Vector3d& b);
/// A⁻¹ b of a matrix that has an inverse.
Eigen::Vector3d solve(const Eigen::Matrix3d& a, const Eigen::Vector3d& b);
MatrixXd inverse(const MatrixXd& a);
/// N = L Lᵀ.
class Cholesky {
 public:
  Cholesky() = default;
  /// Its lower triangle is read.
  explicit Cholesky(const MatrixXd& n);
  bool positive_definite() const { return factors_.info() == Eigen::Success; }
  /// 1 over the condition number in the 1-norm, about.
  double reciprocal_condition() const;
  /// ln det N.
  double log_determinant() const;
  MatrixXd lower() const;
  /// N⁻¹ b and N⁻¹ B.
  VectorXd solve(const VectorXd& b) const;
  MatrixXd solve(const MatrixXd& b) const;
  MatrixXd inverse() const;

 private:
  Eigen::LLT<MatrixXd> factors_;
};
/// Σ = L Lᵀ of a covariance, also one without inverse, its rows and columns in the order that makes
/// L triangular.
struct PivotedRoot {
  Eigen::VectorXi order;
  MatrixXd lower;
};
PivotedRoot pivoted_root(const MatrixXd& covariance);
/// L⁻¹ B of the lower triangle of a matrix.
MatrixXd solve_lower(const Eigen::Ref<const MatrixXd>& l, const MatrixXd& b);
VectorXd solve_lower(const Eigen::Ref<const MatrixXd>& l, const VectorXd& b);

/// S = V diag(λ) Vᵀ of a symmetric matrix, λ ascending.
struct Spectrum {
  VectorXd values;
  MatrixXd vectors;
};
Spectrum spectrum(const MatrixXd& symmetric);
VectorXd eigenvalues(const MatrixXd& symmetric);
/// A = U diag(σ) Vᵀ, σ descending; values below `threshold` of the largest count as none (0:
/// rounding).
struct SingularSystem {
  VectorXd values;
  MatrixXd right;  ///< V
  VectorXd x;      ///< the shortest of least |A x − b|
  Eigen::Index rank = 0;
};
SingularSystem singular_system(const MatrixXd& a, const VectorXd& b, double threshold = 0.0);

}  // namespace trueaxis::linear
