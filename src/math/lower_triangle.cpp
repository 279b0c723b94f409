// SPDX-License-Identifier: Apache-2.0
#include "math/lower_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/lower_triangle.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;

void sum_parts(std::span<const LowerTriangle::Part> parts, LowerTriangle& out) {
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  for (std::size_t j = 0; j < out.size(); ++j) {
    for (std::size_t i = j / lanes * lanes; i < out.stride(); i += lanes) {
      auto sum = hn::Zero(tag);
      for (const LowerTriangle::Part& part : parts)
        sum = hn::MulAdd(hn::Set(tag, part.factor), hn::Load(tag, part.of->column(j) + i), sum);
      hn::Store(sum, tag, out.column(j) + i);
    }
  }
}

// Rows from `i` on, `Vectors` vectors of them, of column k less those of the columns before it.
template <std::size_t Vectors>
HWY_INLINE void take_out(LowerTriangle& of, std::size_t k, std::size_t before, std::size_t i) {
  const Tag tag;
  using V = hn::Vec<Tag>;
  V left[Vectors];
  for (std::size_t v = 0; v < Vectors; ++v)
    left[v] = hn::Load(tag, of.column(k) + i + v * hn::Lanes(tag));
  for (std::size_t j = 0; j < before; ++j) {
    const double* column = of.column(j);
    const V factor = hn::Set(tag, column[k]);
    for (std::size_t v = 0; v < Vectors; ++v)
      left[v] = hn::NegMulAdd(factor, hn::Load(tag, column + i + v * hn::Lanes(tag)), left[v]);
  }
  for (std::size_t v = 0; v < Vectors; ++v)
    hn::Store(left[v], tag, of.column(k) + i + v * hn::Lanes(tag));
}

bool eliminate_first(LowerTriangle& of, std::size_t count) {
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  for (std::size_t k = 0; k < of.size(); ++k) {
    const std::size_t before = std::min(k, count);
    std::size_t i = k / lanes * lanes;
    for (; i + 4 * lanes <= of.stride(); i += 4 * lanes) take_out<4>(of, k, before, i);
    for (; i < of.stride(); i += lanes) take_out<1>(of, k, before, i);
    if (k >= count) continue;
    double* column = of.column(k);
    if (!(column[k] > 0.0)) return false;
    const double pivot = std::sqrt(column[k]);
    for (i = k / lanes * lanes; i < of.stride(); i += lanes)
      hn::Store(hn::Div(hn::Load(tag, column + i), hn::Set(tag, pivot)), tag, column + i);
  }
  return true;
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(sum_parts);
HWY_EXPORT(eliminate_first);

LowerTriangle::LowerTriangle(std::size_t size)
    : size_(size),
      stride_((size + 7) / 8 * 8),
      memory_(hwy::AllocateAligned<double>(size * stride_ + 1)) {
  std::fill_n(memory_.get(), size * stride_, 0.0);
}

void LowerTriangle::become_sum(std::span<const Part> parts) {
  for (const Part& part : parts) expects(part.of->size() == size_, "triangles of one size");
  HWY_DYNAMIC_DISPATCH(sum_parts)(parts, *this);
}

bool LowerTriangle::eliminate(std::size_t count) {
  expects(count <= size_, "columns that are there");
  return HWY_DYNAMIC_DISPATCH(eliminate_first)(*this, count);
}

}  // namespace trueaxis
#endif
