// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

// Eigen's decompositions of dynamic matrices for the tests, compiled once: a test that writes them
// itself compiles them itself, 5 to 40 s each.
namespace trueaxis::dense {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The x of least |A x − b| (QR with pivoting).
VectorXd least_squares(const MatrixXd& a, const VectorXd& b);
MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b);
/// b − A x of that x.
VectorXd residuals(const MatrixXd& a, const VectorXd& b);
/// A⁻¹ of a matrix that has an inverse.
MatrixXd inverse(const MatrixXd& a);
/// S⁻¹ b of a symmetric matrix.
VectorXd solve_symmetric(const MatrixXd& s, const VectorXd& b);
/// Orthonormal columns that span those of A; pivots below `threshold` of the largest do not count.
MatrixXd basis(const MatrixXd& a, double threshold);
/// Left singular vectors of A whose singular values lie above `least`.
MatrixXd directions_above(const MatrixXd& a, double least);
/// Singular values, descending.
VectorXd singular_values(const MatrixXd& a);
/// L of S = L Lᵀ.
MatrixXd cholesky(const MatrixXd& s);
/// L⁻¹ B of a lower triangle.
MatrixXd solve_lower(const MatrixXd& l, const MatrixXd& b);

}  // namespace trueaxis::dense
