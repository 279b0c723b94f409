// SPDX-License-Identifier: Apache-2.0
#include "math/linear_algebra.hpp"

#include <Eigen/Dense>

namespace trueaxis::linear {

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

MatrixXd beside(const MatrixXd& q, const MatrixXd& b) { return b - q * transposed_product(q, b); }

VectorXd beside(const MatrixXd& q, const VectorXd& b) { return b - q * transposed_product(q, b); }

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}

ShortestSolution shortest_solution(const MatrixXd& a, const VectorXd& b) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr(a);
  return {qr.solve(b), qr.pseudoInverse(), qr.rank()};
}

MatrixXd inverse_of_normal(const MatrixXd& n) {
  return n.ldlt().solve(MatrixXd::Identity(n.rows(), n.cols()));
}

VectorXd solve_normal(const MatrixXd& n, const VectorXd& b) { return n.ldlt().solve(b); }

Eigen::Vector3d solve_normal(const Eigen::Matrix3d& n, const Eigen::Vector3d& b) {
  return n.ldlt().solve(b);
}

Eigen::Vector3d solve(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  return a.partialPivLu().solve(b);
}

Cholesky::Cholesky(const MatrixXd& n) : factors_(n) {}

MatrixXd Cholesky::lower() const { return factors_.matrixL(); }

VectorXd Cholesky::solve(const VectorXd& b) const { return factors_.solve(b); }

MatrixXd Cholesky::inverse() const {
  return factors_.solve(MatrixXd::Identity(factors_.rows(), factors_.cols()));
}

MatrixXd solve_lower(const Eigen::Ref<const MatrixXd>& l, const MatrixXd& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

VectorXd solve_lower(const Eigen::Ref<const MatrixXd>& l, const VectorXd& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

Spectrum spectrum(const MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace trueaxis::linear
