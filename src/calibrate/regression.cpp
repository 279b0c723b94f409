// SPDX-License-Identifier: Apache-2.0
#include "calibrate/regression.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rank_of_base = 1e-9;
constexpr double same = 1e-4;  // of an orthonormal column: what others leave of it is rounding

/// G⁻¹ c with what stays below `same` left out.
VectorXd solved(const MatrixXd& products, const VectorXd& right) {
  if (products.rows() == 0) return right;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(products);
  const VectorXd inverse =
      (eigen.eigenvalues().array() > same).select(eigen.eigenvalues().cwiseInverse(), 0.0);
  return eigen.eigenvectors() * (inverse.asDiagonal() * (eigen.eigenvectors().transpose() * right));
}

}  // namespace

double gain_of(const MatrixXd& products, const VectorXd& right) {
  if (products.rows() == 0) return 0.0;
  if (products.rows() == 1)
    return products(0, 0) > same ? right[0] * right[0] / products(0, 0) : 0.0;
  if (products.rows() == 2) {
    const double det = products(0, 0) * products(1, 1) - products(0, 1) * products(1, 0);
    if (det > same * products.trace())
      return (products(1, 1) * right[0] * right[0] - 2.0 * products(0, 1) * right[0] * right[1] +
              products(0, 0) * right[1] * right[1]) /
             det;
  }
  return right.dot(solved(products, right));
}

Regression::Regression(const std::vector<Term>& terms, const MatrixXd& base,
                       const VectorXd& weights, double largest_length_mm,
                       double largest_angle_rad) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(base);
  qr.setThreshold(rank_of_base);
  basis_ = qr.householderQ() * MatrixXd::Identity(base.rows(), qr.rank());
  freedom_ = static_cast<double>(base.rows() - qr.rank());
  Index all = 0;
  for (const Term& term : terms) all += term.columns.cols();
  MatrixXd columns(base.rows(), all);
  all = 0;
  for (const Term& term : terms) {
    columns.middleCols(all, term.columns.cols()) = weights.asDiagonal() * term.columns;
    all += term.columns.cols();
  }
  for (int twice = 0; twice < 2; ++twice) columns -= basis_ * (basis_.transpose() * columns);
  orthonormal_.resize(base.rows(), all);
  Index from = 0, to = 0;
  for (const Term& term : terms) {
    const Index q = term.columns.cols();
    const auto own = columns.middleCols(from, q);
    const double largest = term.angle ? largest_angle_rad : largest_length_mm;
    const MatrixXd gram = own.transpose() * own;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
    Block block{to, 0, MatrixXd::Zero(q, q), gram.trace() / static_cast<double>(q),
                std::max(0.0, eigen.eigenvalues()[0])};
    for (Index k = 0; k < q; ++k) {
      const double value = eigen.eigenvalues()[k];
      if (!(value * largest * largest >= 1.0)) continue;
      block.back.col(block.rank) = eigen.eigenvectors().col(k) / std::sqrt(value);
      ++block.rank;
    }
    block.back.conservativeResize(q, block.rank);
    orthonormal_.middleCols(to, block.rank) = own * block.back;
    to += block.rank;
    from += q;
    blocks_.push_back(std::move(block));
  }
  orthonormal_.conservativeResize(base.rows(), to);
  products_ = orthonormal_.transpose() * orthonormal_;
}

void Regression::take(const VectorXd& residuals) {
  residuals_ = residuals - basis_ * (basis_.transpose() * residuals);
  right_ = orthonormal_.transpose() * residuals_;
  rss_ = residuals_.squaredNorm();
}

std::vector<Index> Regression::columns_of(const Set& set) const {
  std::vector<Index> columns;
  for (const std::size_t term : set)
    for (Index k = 0; k < blocks_[term].rank; ++k) columns.push_back(blocks_[term].first + k);
  return columns;
}

Index Regression::rank(const Set& set) const {
  Index sum = 0;
  for (const std::size_t term : set) sum += blocks_[term].rank;
  return sum;
}

double Regression::gain(const Set& set) const {
  if (set.empty()) return 0.0;
  const auto columns = columns_of(set);
  return gain_of(products_(columns, columns), right_(columns));
}

VectorXd Regression::coefficients(const Set& set) const {
  const auto columns = columns_of(set);
  return solved(products_(columns, columns), right_(columns));
}

Regression::Beside Regression::beside(const Set& others) const {
  Beside out{products_, right_, rss_, freedom_ - static_cast<double>(rank(others))};
  if (others.empty()) return out;
  const auto columns = columns_of(others);
  const MatrixXd cross = products_(columns, Eigen::all);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(products_(columns, columns)));
  const VectorXd root = (eigen.eigenvalues().array() > same)
                            .select(eigen.eigenvalues().cwiseSqrt().cwiseInverse(), 0.0);
  const MatrixXd half = root.asDiagonal() * eigen.eigenvectors().transpose();
  const MatrixXd whitened = half * cross;
  const VectorXd along = half * right_(columns);
  out.products.noalias() -= whitened.transpose() * whitened;
  out.right -= whitened.transpose() * along;
  out.rss -= along.squaredNorm();
  return out;
}

}  // namespace trueaxis::calibrate_detail
