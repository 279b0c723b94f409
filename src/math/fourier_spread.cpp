// SPDX-License-Identifier: Apache-2.0
#include "math/fourier_spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/fourier_spread.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 4>;  // a third of the kernel

constexpr std::size_t batch = 64;  // points whose kernels are kept at a time

void kernel_values(const double* distance, std::size_t count, double (*out)[spread_width]) {
  const Tag tag;
  const SpreadPolynomials& factor = spread_polynomials();
  for (std::size_t i = 0; i < count; ++i) {
    const auto v = hn::Set(tag, 2.0 * distance[i] + static_cast<double>(spread_width) - 1.0);
    for (std::size_t l = 0; l < spread_width; l += hn::Lanes(tag)) {
      auto sum = hn::LoadU(tag, factor[spread_degree].data() + l);
      for (std::size_t k = spread_degree; k-- > 0;)
        sum = hn::MulAdd(sum, v, hn::LoadU(tag, factor[k].data() + l));
      hn::StoreU(sum, tag, out[i] + l);
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

// Interpolation at the Chebyshev nodes, its series in T_n summed into powers.
const SpreadPolynomials& spread_polynomials() {
  static const SpreadPolynomials made = [] {
    constexpr std::size_t n = spread_degree + 1;
    constexpr long double pi = std::numbers::pi_v<long double>, half = 0.5L * spread_width;
    SpreadPolynomials out{};
    for (std::size_t l = 0; l < spread_width; ++l) {
      std::array<long double, n> before{}, now{}, sum{};  // powers of T_{m−1}, T_m
      before[1] = now[0] = 1.0L;                          // T_{−1} = T_1
      for (std::size_t m = 0; m < n; ++m) {
        long double of_t = 0.0L;
        for (std::size_t j = 0; j < n; ++j) {
          const long double angle = pi * (static_cast<long double>(j) + 0.5L) / n;
          const long double x =
              (0.5L * (std::cos(angle) + 1.0L) - half + static_cast<long double>(l)) / half;
          of_t += std::exp(spread_beta * (std::sqrt(std::max(0.0L, 1.0L - x * x)) - 1.0L)) *
                  std::cos(angle * static_cast<long double>(m));
        }
        for (std::size_t k = 0; k < n; ++k) sum[k] += (m == 0 ? 1.0L : 2.0L) / n * of_t * now[k];
        std::array<long double, n> next{};
        for (std::size_t k = 0; k < n; ++k)
          next[k] = (k > 0 ? 2.0L * now[k - 1] : 0.0L) - before[k];
        before = now, now = next;
      }
      for (std::size_t k = 0; k < n; ++k) out[k][l] = static_cast<double>(sum[k]);
    }
    return out;
  }();
  return made;
}

void spread(const SpreadPoints& points, std::span<const SpreadColumn> columns) {
  HWY_DYNAMIC_DISPATCH(spread_columns)(points, columns);
}

}  // namespace trueaxis
#endif
