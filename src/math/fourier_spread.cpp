// SPDX-License-Identifier: Apache-2.0
#include "math/fourier_spread.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/fourier_spread.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After highway.h, as it is compiled once for every instruction set too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 4>;  // a third of the kernel

constexpr std::size_t batch = 64;  // points whose kernels are kept at a time

void kernel_values(const double* distance, std::size_t count, double (*out)[spread_width]) {
  const Tag tag;
  const auto one = hn::Set(tag, 1.0), beta = hn::Set(tag, spread_beta);
  const auto half_inverse = hn::Set(tag, 2.0 / static_cast<double>(spread_width));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t l = 0; l < spread_width; l += hn::Lanes(tag)) {
      const auto x = hn::Mul(half_inverse, hn::Iota(tag, distance[i] + static_cast<double>(l)));
      const auto root = hn::Sqrt(hn::Max(hn::NegMulAdd(x, x, one), hn::Zero(tag)));
      hn::StoreU(hn::Exp(tag, hn::Mul(beta, hn::Sub(root, one))), tag, out[i] + l);
    }
  }
}

HWY_INLINE void add(double factor, const double* kernel, double* grid) {
  const Tag tag;
  for (std::size_t l = 0; l < spread_width; l += hn::Lanes(tag)) {
    const auto sum =
        hn::MulAdd(hn::Set(tag, factor), hn::LoadU(tag, kernel + l), hn::LoadU(tag, grid + l));
    hn::StoreU(sum, tag, grid + l);
  }
}

void spread_columns(const SpreadPoints& points, std::span<const SpreadColumn> columns) {
  double kernel[batch][spread_width];
  for (std::size_t from = 0; from < points.first.size(); from += batch) {
    const std::size_t end = std::min(from + batch, points.first.size());
    kernel_values(points.distance.data() + from, end - from, kernel);
    for (const SpreadColumn& column : columns) {
      for (std::size_t i = from; i < end; ++i) {
        const std::size_t at = points.first[i];
        add(column.value[i] * points.cosine[i], kernel[i - from], column.real + at);
        add(column.value[i] * points.sine[i], kernel[i - from], column.imaginary + at);
      }
    }
  }
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(spread_columns);

void spread(const SpreadPoints& points, std::span<const SpreadColumn> columns) {
  HWY_DYNAMIC_DISPATCH(spread_columns)(points, columns);
}

}  // namespace trueaxis
#endif
