// SPDX-License-Identifier: Apache-2.0
#include "math/linear_algebra.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace trueaxis::linear {
namespace {

/// Eigen cuts a product into blocks by the caches of the processor, so that its last digits, and
/// what a Markov chain makes of them, were those of the machine. With these they are the same.
[[maybe_unused]] const bool same_everywhere =
    (Eigen::setCpuCacheSizes(32 * 1024, 512 * 1024, 16 * 1024 * 1024), true);

}  // namespace
namespace {

Eigen::CompleteOrthogonalDecomposition<MatrixXd> orthogonal(const MatrixXd& a, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors;
  if (threshold > 0.0) factors.setThreshold(threshold);
  factors.compute(a);
  return factors;
}

}  // namespace

MatrixXd product(const MatrixXd& a, const MatrixXd& b) { return a * b; }

MatrixXd gram(const MatrixXd& a) { return a.transpose() * a; }

MatrixXd product_transposed(const MatrixXd& a, const MatrixXd& b) { return a * b.transpose(); }

MatrixXd transposed_product(const MatrixXd& a, const MatrixXd& b) { return a.transpose() * b; }

VectorXd transposed_product(const MatrixXd& a, const VectorXd& b) { return a.transpose() * b; }

MatrixXd scaled_columns(const MatrixXd& a, const VectorXd& w) { return a * w.asDiagonal(); }

MatrixXd scaled_rows(const VectorXd& w, const MatrixXd& a) { return w.asDiagonal() * a; }

MatrixXd scaled_both(const MatrixXd& a, const VectorXd& w) {
  return w.asDiagonal() * a * w.asDiagonal();
}

MatrixXd propagated(const MatrixXd& a, const MatrixXd& c) { return a * c * a.transpose(); }

MatrixXd orthonormal_basis(const MatrixXd& a, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  if (threshold > 0.0) qr.setThreshold(threshold);
  return qr.householderQ() * MatrixXd::Identity(a.rows(), qr.rank());
}

MatrixXd orthonormal_basis_above(const MatrixXd& a, double least) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  qr.setThreshold(least / std::max(qr.maxPivot(), std::numeric_limits<double>::min()));
  return qr.householderQ() * MatrixXd::Identity(a.rows(), qr.rank());
}

MatrixXd beside(const MatrixXd& q, const MatrixXd& b) { return b - q * transposed_product(q, b); }

VectorXd beside(const MatrixXd& q, const VectorXd& b) { return b - q * transposed_product(q, b); }

VectorXd pivoted_least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

MatrixXd pivoted_least_squares(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

VectorXd least_squares(const MatrixXd& a, const VectorXd& b, double threshold) {
  return orthogonal(a, threshold).solve(b);
}

MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b, double threshold) {
  return orthogonal(a, threshold).solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  return least_squares(a, MatrixXd(MatrixXd::Identity(a.rows(), a.rows())));
}

ShortestSolution shortest_solution(const MatrixXd& a, const VectorXd& b) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr(a);
  return {qr.solve(b), qr.solve(MatrixXd(MatrixXd::Identity(a.rows(), a.rows()))), qr.rank()};
}

MatrixXd inverse_of_normal(const MatrixXd& n) {
  return solve_normal(n, MatrixXd(MatrixXd::Identity(n.rows(), n.cols())));
}

VectorXd solve_normal(const MatrixXd& n, const VectorXd& b) { return n.ldlt().solve(b); }

MatrixXd solve_normal(const MatrixXd& n, const MatrixXd& b) { return n.ldlt().solve(b); }

double weighed_square(const VectorXd& v, const MatrixXd& n) { return v.dot(solve_normal(n, v)); }

Eigen::Vector3d solve_normal(const Eigen::Matrix3d& n, const Eigen::Vector3d& b) {
  return n.ldlt().solve(b);
}

Eigen::Vector3d solve(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  return a.partialPivLu().solve(b);
}

Cholesky::Cholesky(const MatrixXd& n) : factors_(n) {}

double Cholesky::reciprocal_condition() const { return factors_.rcond(); }

double Cholesky::log_determinant() const {
  return 2.0 * factors_.matrixLLT().diagonal().array().log().sum();
}

MatrixXd Cholesky::lower() const { return factors_.matrixL(); }

VectorXd Cholesky::solve(const VectorXd& b) const { return factors_.solve(b); }

MatrixXd Cholesky::solve(const MatrixXd& b) const { return factors_.solve(b); }

MatrixXd Cholesky::inverse() const {
  return solve(MatrixXd(MatrixXd::Identity(factors_.rows(), factors_.cols())));
}

PivotedRoot pivoted_root(const MatrixXd& covariance) {
  const Eigen::LDLT<MatrixXd> factors(covariance);
  const Eigen::Index n = covariance.rows();
  return {factors.transpositionsP() * Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(n) - 1),
          scaled_columns(factors.matrixL(), factors.vectorD().cwiseMax(0.0).cwiseSqrt())};
}

MatrixXd solve_lower(const Eigen::Ref<const MatrixXd>& l, const MatrixXd& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

VectorXd solve_lower(const Eigen::Ref<const MatrixXd>& l, const VectorXd& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

Spectrum spectrum(const MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

SingularSystem singular_system(const MatrixXd& a, const VectorXd& b, double threshold) {
  Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (threshold > 0.0) svd.setThreshold(threshold);
  return {svd.singularValues(), svd.matrixV(), svd.solve(b), svd.rank()};
}

}  // namespace trueaxis::linear
