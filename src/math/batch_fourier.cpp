// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

#include "math/fast_fourier.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/batch_fourier.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, BatchFourier::batch>;
using V = hn::Vec<Tag>;

struct Complex {
  V real, imaginary;
};
HWY_INLINE Complex operator+(Complex a, Complex b) {
  return {hn::Add(a.real, b.real), hn::Add(a.imaginary, b.imaginary)};
}
HWY_INLINE Complex operator-(Complex a, Complex b) {
  return {hn::Sub(a.real, b.real), hn::Sub(a.imaginary, b.imaginary)};
}
HWY_INLINE Complex times(double factor, Complex a) {
  const V by = hn::Set(Tag(), factor);
  return {hn::Mul(by, a.real), hn::Mul(by, a.imaginary)};
}
HWY_INLINE Complex times_minus_i(Complex a) { return {a.imaginary, hn::Neg(a.real)}; }
HWY_INLINE Complex times(std::complex<double> factor, Complex a) {
  const V real = hn::Set(Tag(), factor.real()), imaginary = hn::Set(Tag(), factor.imag());
  return {hn::NegMulAdd(imaginary, a.imaginary, hn::Mul(real, a.real)),
          hn::MulAdd(real, a.imaginary, hn::Mul(imaginary, a.real))};
}

HWY_INLINE void transform(std::array<Complex, 2>& a) { a = {a[0] + a[1], a[0] - a[1]}; }

HWY_INLINE void transform(std::array<Complex, 3>& a) {
  constexpr double sine = 0.86602540378443864676;  // of a third of a turn
  const Complex sum = a[1] + a[2], across = times_minus_i(times(sine, a[1] - a[2]));
  const Complex middle = a[0] - times(0.5, sum);
  a = {a[0] + sum, middle + across, middle - across};
}

HWY_INLINE void transform(std::array<Complex, 4>& a) {
  const Complex even = a[0] + a[2], odd = a[1] + a[3], even2 = a[0] - a[2],
                odd2 = times_minus_i(a[1] - a[3]);
  a = {even + odd, even2 + odd2, even - odd, even2 - odd2};
}

HWY_INLINE void transform(std::array<Complex, 5>& a) {
  // Of one and of two fifths of a turn.
  constexpr double cosine1 = 0.30901699437494742410, cosine2 = -0.80901699437494742410,
                   sine1 = 0.95105651629515357212, sine2 = 0.58778525229247312917;
  const Complex near = a[1] + a[4], far = a[2] + a[3], near2 = a[1] - a[4], far2 = a[2] - a[3];
  const Complex middle1 = a[0] + times(cosine1, near) + times(cosine2, far),
                middle2 = a[0] + times(cosine2, near) + times(cosine1, far);
  const Complex across1 = times_minus_i(times(sine1, near2) + times(sine2, far2)),
                across2 = times_minus_i(times(sine2, near2) - times(sine1, far2));
  a = {a[0] + near + far, middle1 + across1, middle2 + across2, middle2 - across2,
       middle1 - across1};
}

/// One step: `size` values of a transform yet to be done, `stride` of them side by side.
template <std::size_t Radix>
void step(const std::complex<double>* roots, std::size_t size, std::size_t stride,
          BatchFourier::Values from, BatchFourier::Values to) {
  constexpr std::size_t batch = BatchFourier::batch;
  const Tag tag;
  const std::size_t part = size / Radix;
  for (std::size_t p = 0; p < part; ++p) {
    for (std::size_t at = 0; at < stride * batch; at += hn::Lanes(tag)) {
      std::array<Complex, Radix> a;
      for (std::size_t k = 0; k < Radix; ++k) {
        const std::size_t i = stride * (p + part * k) * batch + at;
        a[k] = {hn::Load(tag, from.real + i), hn::Load(tag, from.imaginary + i)};
      }
      transform(a);
      for (std::size_t j = 0; j < Radix; ++j) {
        const std::size_t i = stride * (Radix * p + j) * batch + at;
        if (j > 0 && p > 0) a[j] = times(roots[p * j * stride], a[j]);
        hn::Store(a[j].real, tag, to.real + i);
        hn::Store(a[j].imaginary, tag, to.imaginary + i);
      }
    }
  }
}

BatchFourier::Values transform_all(const std::vector<std::size_t>& radices,
                                   const std::vector<std::complex<double>>& roots,
                                   BatchFourier::Values x, BatchFourier::Values other) {
  std::size_t size = roots.size(), stride = 1;
  for (const std::size_t radix : radices) {
    const auto one = radix == 5   ? &step<5>
                     : radix == 4 ? &step<4>
                     : radix == 3 ? &step<3>
                                  : &step<2>;
    one(roots.data(), size, stride, x, other);
    std::swap(x, other);
    size /= radix, stride *= radix;
  }
  return x;
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(transform_all);

BatchFourier::BatchFourier(std::size_t n) {
  std::size_t left = n;
  for (const std::size_t radix : {5U, 4U, 3U, 2U})
    for (; left % radix == 0; left /= radix) radices_.push_back(radix);
  expects(left == 1, "a length of factors 2, 3 and 5");
  for (std::size_t m = 0; m < n; ++m) {
    const double angle = two_pi * static_cast<double>(m) / static_cast<double>(n);
    roots_.emplace_back(std::cos(angle), -std::sin(angle));
  }
}

BatchFourier::Values BatchFourier::operator()(Values x, Values other) const {
  return HWY_DYNAMIC_DISPATCH(transform_all)(radices_, roots_, x, other);
}

}  // namespace trueaxis
#endif
