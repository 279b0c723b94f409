// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/normal_equations.hpp"
#include "math/gram.hpp"
#include "math/wide_gram.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// Calls with the first column and the number of columns of each group.
template <class Call>
void for_each_group(const Appended& of, Call call) {
  std::size_t begin = of.together;
  for (const std::size_t end : of.ends) {
    call(begin, end - begin);
    begin = end;
  }
}

void add_both(Eigen::MatrixXd& gram, std::size_t i, std::size_t j, double value) {
  const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
  gram(row, column) += value;
  if (row != column) gram(column, row) += value;
}

}  // namespace

GramSums::GramSums(const Appended& of)
    : of_(&of),
      fitted_(gram_size(of.together - of.before), 0.0),
      cross_((of.together - of.before) * of.before, 0.0),
      apart_((of.columns() - of.together) * of.together, 0.0) {
  std::size_t size = 0;
  for_each_group(of, [&](std::size_t, std::size_t count) { size += gram_size(count); });
  groups_.assign(size, 0.0);
}

void GramSums::add(std::span<const double* const> columns, std::size_t rows) {
  const WideBlock there{columns.first(of_->before), rows},
      fitted{columns.subspan(of_->before, of_->together - of_->before), rows},
      beside{columns.first(of_->together), rows}, apart{columns.subspan(of_->together), rows};
  add_wide_products(fitted, fitted_);
  add_cross_products(fitted, there, cross_);
  add_cross_products(apart, beside, apart_);
  std::size_t at = 0;
  for_each_group(*of_, [&](std::size_t begin, std::size_t count) {
    const std::span<double> own = std::span(groups_).subspan(at, gram_size(count));
    add_wide_products({columns.subspan(begin, count), rows}, own);
    at += own.size();
  });
}

void GramSums::add_to(Eigen::MatrixXd& gram) const {
  const std::size_t before = of_->before, together = of_->together;
  for (std::size_t i = before; i < together; ++i) {
    for (std::size_t j = 0; j < before; ++j)
      add_both(gram, i, j, cross_[(i - before) * before + j]);
    for (std::size_t j = before; j <= i; ++j)
      add_both(gram, i, j, fitted_[gram_index(i - before, j - before)]);
  }
  for (std::size_t i = together; i < of_->columns(); ++i)
    for (std::size_t j = 0; j < together; ++j)
      add_both(gram, i, j, apart_[(i - together) * together + j]);
  std::size_t at = 0;
  for_each_group(*of_, [&](std::size_t begin, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        add_both(gram, begin + i, begin + j, groups_[at + gram_index(i, j)]);
    at += gram_size(count);
  });
}

}  // namespace trueaxis::diagnose_detail
