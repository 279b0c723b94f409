// SPDX-License-Identifier: Apache-2.0
#include "infer/dictionary.hpp"

#include <algorithm>
#include <cmath>

#include "infer/stepwise.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::infer {
namespace {

constexpr double rank_of_base = 1e-9;

}  // namespace

Dictionary::Dictionary(const std::vector<Hypothesis>& hypotheses, const Eigen::MatrixXd& base) {
  using Eigen::Index;
  basis_ = linear::orthonormal_basis(base, rank_of_base);
  rows_ = static_cast<std::size_t>(base.rows() - basis_.cols());
  Index all = 1;
  for (const Hypothesis& one : hypotheses) all += one.columns.cols();
  all_ = Eigen::MatrixXd::Zero(base.rows(), all);
  Index to = 1;
  for (const Hypothesis& one : hypotheses) {
    const Eigen::MatrixXd own = linear::beside(basis_, linear::beside(basis_, one.columns));
    const Index q = own.cols();
    const linear::Spectrum eigen = linear::spectrum(linear::gram(own));
    Block block;
    block.name = one.name;
    block.back = Eigen::MatrixXd::Zero(q, q);
    block.largest = one.largest, block.tests = one.tests;
    block.pattern = one.pattern, block.barred = one.barred;
    std::vector<double> medians;
    for (Index k = 0; k < q; ++k) {
      const double value = eigen.values[k];
      if (!(value * one.largest * one.largest >= 1.0)) continue;
      const auto at = static_cast<Index>(block.columns.size());
      block.back.col(at) = eigen.vectors.col(k) / std::sqrt(value);
      medians.push_back(one.size_median * std::sqrt(value));
      block.columns.push_back(static_cast<std::size_t>(to + at));
    }
    const auto rank = static_cast<Index>(block.columns.size());
    block.back.conservativeResize(q, rank);
    block.prior.median = Eigen::Map<const Eigen::VectorXd>(medians.data(), rank);
    block.prior.spread = one.size_spread;
    all_.middleCols(to, rank) = linear::product(own, block.back);
    to += rank;
    blocks_.push_back(std::move(block));
  }
  all_.conservativeResize(Eigen::NoChange, to);
  gram_ = linear::gram(all_);
}

void Dictionary::take(const Eigen::VectorXd& residuals) {
  all_.col(0) = linear::beside(basis_, residuals);
  gram_.col(0) = linear::transposed_product(all_, Eigen::VectorXd(all_.col(0)));
  gram_.row(0) = gram_.col(0).transpose();
}

Fitted Dictionary::model(const Set& set) const {
  Fitted out{gram_, {}, {}, rows_};
  for (const std::size_t term : set) out.terms.push_back(blocks_[term].columns);
  return out;
}

double Dictionary::variance(const Set& set) const {
  const Solution all = fitted(set);
  return all.rss / static_cast<double>(rows_ - all.rank);
}

Weighed Dictionary::weighed(std::size_t term, const Projection& others,
                            const Columns& columns) const {
  const Block& block = blocks_[term];
  Weighed out = weigh(block.prior, others, columns, rows_);
  out.criterion +=
      2.0 * std::log(std::max(1.0, block.tests)) + (block.pattern ? catalogue_first : 0.0);
  return out;
}

double Dictionary::tests() const {
  double tests = 0.0;
  for (const Block& block : blocks_)
    if (!block.pattern && !block.columns.empty()) tests += block.tests;
  return std::max(1.0, tests);
}

double Dictionary::independent_tests() const {
  Columns columns;
  for (const Block& block : blocks_)
    if (!block.pattern) columns.insert(columns.end(), block.columns.begin(), block.columns.end());
  if (columns.empty()) return 0.0;
  const Eigen::MatrixXd products = gram_(columns, columns);
  double sum = 0.0;
  for (const double value : linear::eigenvalues(products))
    if (value > 1e-9) sum += (value >= 1.0 ? 1.0 : 0.0) + value - std::floor(value);
  return sum;
}

Dictionary::Set with_last(const Dictionary::Set& set, std::size_t at) {
  Dictionary::Set out = without(set, at);
  out.push_back(set[at]);
  return out;
}

}  // namespace trueaxis::infer
