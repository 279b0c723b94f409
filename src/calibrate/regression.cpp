// SPDX-License-Identifier: Apache-2.0
#include "calibrate/regression.hpp"

#include <Eigen/Core>
#include <cmath>

#include "math/linear_algebra.hpp"

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
  const linear::Spectrum of = linear::spectrum(products);
  const VectorXd inverse = (of.values.array() > same).select(of.values.cwiseInverse(), 0.0);
  const VectorXd along = linear::transposed_product(of.vectors, right);
  return of.vectors * VectorXd(inverse.cwiseProduct(along));
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
  basis_ = linear::orthonormal_basis(base, rank_of_base);
  freedom_ = static_cast<double>(base.rows() - basis_.cols());
  Index all = 0;
  for (const Term& term : terms) all += term.columns.cols();
  MatrixXd columns(base.rows(), all);
  all = 0;
  for (const Term& term : terms) {
    columns.middleCols(all, term.columns.cols()) = linear::scaled_rows(weights, term.columns);
    all += term.columns.cols();
  }
  for (int twice = 0; twice < 2; ++twice) columns = linear::beside(basis_, columns);
  orthonormal_.resize(base.rows(), all);
  Index from = 0, to = 0;
  for (const Term& term : terms) {
    const Index q = term.columns.cols();
    const MatrixXd own = columns.middleCols(from, q);
    const double largest = term.angle ? largest_angle_rad : largest_length_mm;
    const MatrixXd gram = linear::gram(own);
    const linear::Spectrum of = linear::spectrum(gram);
    Block block{to, 0, MatrixXd::Zero(q, q), gram.trace() / static_cast<double>(q),
                std::max(0.0, of.values[0])};
    for (Index k = 0; k < q; ++k) {
      const double value = of.values[k];
      if (!(value * largest * largest >= 1.0)) continue;
      block.back.col(block.rank) = of.vectors.col(k) / std::sqrt(value);
      ++block.rank;
    }
    block.back.conservativeResize(q, block.rank);
    orthonormal_.middleCols(to, block.rank) = linear::product(own, block.back);
    to += block.rank;
    from += q;
    blocks_.push_back(std::move(block));
  }
  orthonormal_.conservativeResize(base.rows(), to);
  products_ = linear::gram(orthonormal_);
}

void Regression::take(const VectorXd& residuals) {
  residuals_ = linear::beside(basis_, residuals);
  right_ = linear::transposed_product(orthonormal_, residuals_);
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
  const linear::Spectrum of = linear::spectrum(products_(columns, columns));
  const VectorXd root =
      (of.values.array() > same).select(of.values.cwiseSqrt().cwiseInverse(), 0.0);
  const MatrixXd half = linear::scaled_rows(root, of.vectors.transpose());
  const MatrixXd whitened = linear::product(half, cross);
  const VectorXd along = half * VectorXd(right_(columns));
  out.products -= linear::gram(whitened);
  out.right -= linear::transposed_product(whitened, along);
  out.rss -= along.squaredNorm();
  return out;
}

}  // namespace trueaxis::calibrate_detail
