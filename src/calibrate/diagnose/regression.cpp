// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/regression.hpp"

#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rank_of_base = 1e-9;

}  // namespace

Regression::Regression(const std::vector<Term>& terms, const MatrixXd& base,
                       const VectorXd& weights, double largest_length_mm,
                       double largest_angle_rad) {
  basis_ = linear::orthonormal_basis(base, rank_of_base);
  rows_ = static_cast<std::size_t>(base.rows() - basis_.cols());
  Index all = 1;
  for (const Term& term : terms) all += term.columns.cols();
  all_ = MatrixXd::Zero(base.rows(), all);
  Index to = 1;
  for (const Term& term : terms) {
    const MatrixXd own =
        linear::beside(basis_, linear::beside(basis_, linear::scaled_rows(weights, term.columns)));
    const Index q = own.cols();
    const double largest = term.angle ? largest_angle_rad : largest_length_mm;
    const linear::Spectrum eigen = linear::spectrum(linear::gram(own));
    Block block{{},
                MatrixXd::Zero(q, q),
                eigen.values.sum() / static_cast<double>(q),
                std::max(0.0, eigen.values[0])};
    std::vector<double> medians;
    for (Index k = 0; k < q; ++k) {
      const double value = eigen.values[k];
      if (!(value * largest * largest >= 1.0)) continue;
      const auto at = static_cast<Index>(block.columns.size());
      block.back.col(at) = eigen.vectors.col(k) / std::sqrt(value);
      medians.push_back(term.size_median * std::sqrt(value));
      block.columns.push_back(static_cast<std::size_t>(to + at));
    }
    const auto rank = static_cast<Index>(block.columns.size());
    block.back.conservativeResize(q, rank);
    block.prior.median = Eigen::Map<const VectorXd>(medians.data(), rank);
    block.prior.spread = term.size_spread;
    all_.middleCols(to, rank) = linear::product(own, block.back);
    to += rank;
    blocks_.push_back(std::move(block));
  }
  all_.conservativeResize(Eigen::NoChange, to);
  gram_ = linear::gram(all_);
}

void Regression::take(const VectorXd& residuals) {
  all_.col(0) = linear::beside(basis_, residuals);
  gram_.col(0) = linear::transposed_product(all_, VectorXd(all_.col(0)));
  gram_.row(0) = gram_.col(0).transpose();
}

infer::Columns Regression::columns_of(const Set& set) const {
  infer::Columns columns;
  for (const std::size_t term : set)
    columns.insert(columns.end(), blocks_[term].columns.begin(), blocks_[term].columns.end());
  return columns;
}

double Regression::variance(const Set& set) const {
  const infer::Solution all = fitted(set);
  return all.rss / static_cast<double>(rows_ - all.rank);
}

Regression::Set without(Regression::Set set, std::size_t at) {
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(at));
  return set;
}

Regression::Set with_last(const Regression::Set& set, std::size_t at) {
  Regression::Set out = without(set, at);
  out.push_back(set[at]);
  return out;
}

}  // namespace trueaxis::calibrate_detail
