// SPDX-License-Identifier: Apache-2.0
#include "model/products.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/products.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Rows [row0, row0 + Rows) against columns [column0, column0 + Columns): the sums stay in
// registers.
template <std::size_t Rows, std::size_t Columns>
HWY_INLINE void tile(const double* const* column, std::size_t row0, std::size_t column0,
                     double* gram) {
  const hn::CappedTag<double, block_size> tag;
  using V = hn::Vec<decltype(tag)>;
  V sum[Rows][Columns];
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t j = 0; j < Columns; ++j) sum[i][j] = hn::Zero(tag);
  }
  for (std::size_t at = 0; at < block_size; at += hn::Lanes(tag)) {
    V right[Columns];
    for (std::size_t j = 0; j < Columns; ++j) right[j] = hn::Load(tag, column[column0 + j] + at);
    for (std::size_t i = 0; i < Rows; ++i) {
      const V left = hn::Load(tag, column[row0 + i] + at);
      for (std::size_t j = 0; j < Columns; ++j) sum[i][j] = hn::MulAdd(left, right[j], sum[i][j]);
    }
  }
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t j = 0; j < Columns; ++j) {
      if (column0 + j > row0 + i) continue;
      gram[gram_index(row0 + i, column0 + j)] += hn::GetLane(hn::SumOfLanes(tag, sum[i][j]));
    }
  }
}

template <std::size_t Rows>
HWY_INLINE void tile_row(const double* const* column, std::size_t row0, double* gram) {
  std::size_t j = 0;
  const std::size_t end = row0 + Rows;
  for (; j + 4 <= end; j += 4) tile<Rows, 4>(column, row0, j, gram);
  for (; j + 2 <= end; j += 2) tile<Rows, 2>(column, row0, j, gram);
  for (; j < end; ++j) tile<Rows, 1>(column, row0, j, gram);
}

void products(const double* const* column, std::size_t rows, double* gram) {
  std::size_t i = 0;
  for (; i + 3 <= rows; i += 3) tile_row<3>(column, i, gram);
  for (; i < rows; ++i) tile_row<1>(column, i, gram);
}

void scale(const double* root_weight, std::size_t rows, double* const* column) {
  const hn::CappedTag<double, block_size> tag;
  for (std::size_t at = 0; at < block_size; at += hn::Lanes(tag)) {
    const auto w = hn::Load(tag, root_weight + at);
    for (std::size_t i = 0; i < rows; ++i) {
      hn::Store(hn::Mul(w, hn::Load(tag, column[i] + at)), tag, column[i] + at);
    }
  }
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(products);
HWY_EXPORT(scale);

void add_products(const PredictionBlock& block, std::size_t columns, double* gram) {
  const double* column[max_columns + 1];
  for (std::size_t i = 0; i < columns; ++i) column[i] = block.column[i];
  column[columns] = block.residual;
  HWY_DYNAMIC_DISPATCH(products)(column, columns + 1, gram);
}

double apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                  PredictionBlock& block) {
  alignas(64) double root_weight[block_size] = {};
  double sum_rho = 0.0;
  const double c = loss.threshold_mm;
  for (std::size_t i = 0; i < filled; ++i) {
    const double r = std::abs(block.residual[i]);
    if (loss.kind == LossScale::Kind::huber) {
      root_weight[i] = r <= c ? 1.0 : std::sqrt(c / r);
      sum_rho += r <= c ? r * r : c * (2.0 * r - c);
    } else {
      const double u = std::max(0.0, 1.0 - (r / c) * (r / c));
      root_weight[i] = u;
      sum_rho += c * c / 3.0 * (1.0 - u * u * u);
    }
  }
  double* column[max_columns + 1];
  for (std::size_t i = 0; i < columns; ++i) column[i] = block.column[i];
  column[columns] = block.residual;
  HWY_DYNAMIC_DISPATCH(scale)(root_weight, columns + 1, column);
  return sum_rho;
}

}  // namespace trueaxis
#endif
