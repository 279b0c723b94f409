// SPDX-License-Identifier: Apache-2.0
#include "math/wide_gram.hpp"

#include <algorithm>

#include "math/gram.hpp"
#include "trueaxis/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/wide_gram.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET <= HWY_AVX3  // the sums and one operand of each side in 32 registers, or in 16
constexpr std::size_t tall = 4, wide = 6;
#else
constexpr std::size_t tall = 4, wide = 3;
#endif
constexpr std::size_t chunk = 256;  // rows: 600 columns of them nearly stay in the second cache

// out[i][j] = left i · right j over the rows. A tile at the edge repeats its last column.
template <std::size_t Wide>
HWY_INLINE void tile_products(const double* const* left, const double* const* right,
                              std::size_t rows, double (*out)[Wide]) {
  const hn::CappedTag<double, 8> tag;
  using V = hn::Vec<decltype(tag)>;
  V sum[tall][Wide];
  for (auto& row : sum) {
    for (V& entry : row) entry = hn::Zero(tag);
  }
  for (std::size_t at = 0; at < rows; at += hn::Lanes(tag)) {
    V of_right[Wide];
    for (std::size_t j = 0; j < Wide; ++j) of_right[j] = hn::Load(tag, right[j] + at);
    for (std::size_t i = 0; i < tall; ++i) {
      const V of_left = hn::Load(tag, left[i] + at);
      for (std::size_t j = 0; j < Wide; ++j) {
        sum[i][j] = hn::MulAdd(of_left, of_right[j], sum[i][j]);
      }
    }
  }
  for (std::size_t i = 0; i < tall; ++i) {
    for (std::size_t j = 0; j < Wide; ++j) {
      out[i][j] = hn::GetLane(hn::SumOfLanes(tag, sum[i][j]));
    }
  }
}

// Adds entry (i, j) of the tile at (row0, column0) to place(i, j), for j < limit(i).
template <std::size_t Wide, class Place, class Limit>
HWY_INLINE void add_tile(const WideBlock& left, const WideBlock& right, std::size_t row0,
                         std::size_t column0, std::size_t from, const Place& place,
                         const Limit& limit) {
  const double *of_left[tall], *of_right[Wide];
  for (std::size_t i = 0; i < tall; ++i) {
    of_left[i] = left.column[std::min(row0 + i, left.column.size() - 1)] + from;
  }
  for (std::size_t j = 0; j < Wide; ++j) {
    of_right[j] = right.column[std::min(column0 + j, right.column.size() - 1)] + from;
  }
  double product[tall][Wide];
  tile_products<Wide>(of_left, of_right, std::min(left.rows - from, chunk), product);
  for (std::size_t i = row0; i < std::min(row0 + tall, left.column.size()); ++i) {
    for (std::size_t j = column0; j < std::min(column0 + Wide, limit(i)); ++j) {
      *place(i, j) += product[i - row0][j - column0];
    }
  }
}

template <class Place, class Limit>
HWY_INLINE void add_all(const WideBlock& left, const WideBlock& right, const Place& place,
                        const Limit& limit) {
  for (std::size_t from = 0; from < left.rows; from += chunk) {
    for (std::size_t i = 0; i < left.column.size(); i += tall) {
      const std::size_t end = limit(std::min(i + tall, left.column.size()) - 1);
      std::size_t j = 0;
      for (; j + 2 < end; j += wide) add_tile<wide>(left, right, i, j, from, place, limit);
      if (j < end) add_tile<2>(left, right, i, j, from, place, limit);
    }
  }
}

void wide_products(const WideBlock& block, double* lower) {
  add_all(
      block, block, [&](std::size_t i, std::size_t j) { return lower + gram_index(i, j); },
      [](std::size_t i) { return i + 1; });
}

void cross_products(const WideBlock& left, const WideBlock& right, double* out) {
  const std::size_t columns = right.column.size();
  add_all(
      left, right, [&](std::size_t i, std::size_t j) { return out + i * columns + j; },
      [&](std::size_t) { return columns; });
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(wide_products);
HWY_EXPORT(cross_products);

void add_wide_products(const WideBlock& block, std::span<double> lower) {
  expects(lower.size() == gram_size(block.column.size()), "one entry a pair of columns");
  HWY_DYNAMIC_DISPATCH(wide_products)(block, lower.data());
}

void add_cross_products(const WideBlock& left, const WideBlock& right, std::span<double> out) {
  expects(left.rows == right.rows, "two blocks of the same rows");
  expects(out.size() == left.column.size() * right.column.size(), "one entry a pair of columns");
  HWY_DYNAMIC_DISPATCH(cross_products)(left, right, out.data());
}

}  // namespace trueaxis
#endif
