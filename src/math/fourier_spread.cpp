// SPDX-License-Identifier: Apache-2.0
#include "math/fourier_spread.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/fourier_spread.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After highway.h, as it is compiled once for every instruction set too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void spread_points(const SpreadPoints& points, const double* value, double* real,
                   double* imaginary) {
  const hn::CappedTag<double, 4> tag;
  using V = hn::Vec<decltype(tag)>;
  const V one = hn::Set(tag, 1.0), beta = hn::Set(tag, spread_beta);
  const V half_inverse = hn::Set(tag, 2.0 / static_cast<double>(spread_width));
  for (std::size_t i = 0; i < points.first.size(); ++i) {
    const V re = hn::Set(tag, value[i] * points.cosine[i]);
    const V im = hn::Set(tag, value[i] * points.sine[i]);
    double* to_real = real + points.first[i];
    double* to_imaginary = imaginary + points.first[i];
    for (std::size_t l = 0; l < spread_width; l += hn::Lanes(tag)) {
      const V x = hn::Mul(half_inverse, hn::Iota(tag, points.distance[i] + static_cast<double>(l)));
      const V root = hn::Sqrt(hn::Max(hn::NegMulAdd(x, x, one), hn::Zero(tag)));
      const V weight = hn::Exp(tag, hn::Mul(beta, hn::Sub(root, one)));
      hn::StoreU(hn::MulAdd(re, weight, hn::LoadU(tag, to_real + l)), tag, to_real + l);
      hn::StoreU(hn::MulAdd(im, weight, hn::LoadU(tag, to_imaginary + l)), tag, to_imaginary + l);
    }
  }
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(spread_points);

void spread(const SpreadPoints& points, std::span<const double> value, std::span<double> real,
            std::span<double> imaginary) {
  HWY_DYNAMIC_DISPATCH(spread_points)(points, value.data(), real.data(), imaginary.data());
}

}  // namespace trueaxis
#endif
