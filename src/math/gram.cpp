// SPDX-License-Identifier: Apache-2.0
#include "math/gram.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/gram.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t tile =
    4;  // 4 × 4 sums and their operands fit into 32 registers, nearly into 16

// Rows [row0, row0 + Rows) against columns [column0, column0 + tile), or, on
// the diagonal, against the rows themselves: the sums stay in registers over the block.
template <std::size_t Rows, bool Diagonal>
HWY_INLINE void add_tile(const double* const* column, std::size_t row0, std::size_t column0,
                         LaneSums& sums) {
  const hn::CappedTag<double, LaneSums::lanes> tag;
  using V = hn::Vec<decltype(tag)>;
  constexpr std::size_t columns = Diagonal ? Rows : tile;
  V sum[Rows][columns];
  const auto used = [](std::size_t i, std::size_t j) { return !Diagonal || j <= i; };
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      sum[i][j] =
          used(i, j) ? hn::Load(tag, sums.value[gram_index(row0 + i, column0 + j)]) : hn::Zero(tag);
    }
  }
  for (std::size_t at = 0; at < block_size; at += hn::Lanes(tag)) {
    V right[columns];
    for (std::size_t j = 0; j < columns; ++j) right[j] = hn::Load(tag, column[column0 + j] + at);
    for (std::size_t i = 0; i < Rows; ++i) {
      const V left = Diagonal ? right[Diagonal ? i : 0] : hn::Load(tag, column[row0 + i] + at);
      for (std::size_t j = 0; j < columns; ++j) {
        if (used(i, j)) sum[i][j] = hn::MulAdd(left, right[j], sum[i][j]);
      }
    }
  }
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (used(i, j)) hn::Store(sum[i][j], tag, sums.value[gram_index(row0 + i, column0 + j)]);
    }
  }
}

template <std::size_t Rows>
HWY_INLINE void add_rows(const double* const* column, std::size_t row0, LaneSums& sums) {
  for (std::size_t j = 0; j < row0; j += tile) add_tile<Rows, false>(column, row0, j, sums);
  add_tile<Rows, true>(column, row0, row0, sums);
}

void products(const double* const* column, std::size_t rows, LaneSums& sums) {
  std::size_t i = 0;
  for (; i + tile <= rows; i += tile) add_rows<tile>(column, i, sums);
  switch (rows - i) {
    case 1:
      return add_rows<1>(column, i, sums);
    case 2:
      return add_rows<2>(column, i, sums);
    case 3:
      return add_rows<3>(column, i, sums);
    default:
      return;
  }
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

void add_products(const double* const* column, std::size_t columns, LaneSums& sums) {
  HWY_DYNAMIC_DISPATCH(products)(column, columns, sums);
}

void scale_columns(const double* factor, std::size_t columns, double* const* column) {
  HWY_DYNAMIC_DISPATCH(scale)(factor, columns, column);
}

}  // namespace trueaxis
#endif
