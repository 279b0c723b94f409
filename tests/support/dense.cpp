// SPDX-License-Identifier: Apache-2.0
#include "support/dense.hpp"

#include <Eigen/Dense>

namespace trueaxis::dense {

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}
MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}
VectorXd residuals(const MatrixXd& a, const VectorXd& b) { return b - a * least_squares(a, b); }
MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }
VectorXd solve_symmetric(const MatrixXd& s, const VectorXd& b) { return s.ldlt().solve(b); }

MatrixXd basis(const MatrixXd& a, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  qr.setThreshold(threshold);
  return qr.householderQ() * MatrixXd::Identity(a.rows(), qr.rank());
}

MatrixXd directions_above(const MatrixXd& a, double least) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeThinU);
  return svd.matrixU().leftCols((svd.singularValues().array() > least).count());
}

VectorXd singular_values(const MatrixXd& a) {
  return Eigen::JacobiSVD<MatrixXd>(a).singularValues();
}
MatrixXd cholesky(const MatrixXd& s) { return s.llt().matrixL(); }

MatrixXd solve_lower(const MatrixXd& l, const MatrixXd& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

}  // namespace trueaxis::dense
