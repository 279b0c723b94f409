// SPDX-License-Identifier: Apache-2.0
#include "math/sincos.hpp"

#include <cstddef>

#include "trueaxis/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/sincos.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void sincos_block(const double* angle, std::size_t count, double* sine, double* cosine) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const auto c = [&](double value) { return hn::Set(d, value); };
  const auto polynomial = [&](V z, double a, double b, double e, double f, double g, double h) {
    V sum = hn::MulAdd(z, c(h), c(g));
    sum = hn::MulAdd(z, sum, c(f));
    sum = hn::MulAdd(z, sum, c(e));
    sum = hn::MulAdd(z, sum, c(b));
    return hn::MulAdd(z, sum, c(a));
  };
  const std::size_t lanes = hn::Lanes(d);
  const auto one_vector = [&](const double* in, double* out_sine, double* out_cosine) {
    const V x = hn::LoadU(d, in);
    const V n = hn::Round(hn::Mul(x, c(6.36619772367581382433e-01)));  // quarter turns
    V r = hn::NegMulAdd(n, c(1.57079632673412561417e+00), x);
    r = hn::NegMulAdd(n, c(6.07710050630396597660e-11), r);
    r = hn::NegMulAdd(n, c(2.02226624879595063154e-21), r);
    const V z = hn::Mul(r, r);
    const V s_poly = polynomial(z, -1.66666666666666324348e-01, 8.33333333332248946124e-03,
                                -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                -2.50507602534068634195e-08, 1.58969099521155010221e-10);
    const V s = hn::MulAdd(hn::Mul(z, r), s_poly, r);
    const V c_poly = polynomial(z, 4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                2.08757232129817482790e-09, -1.13596475577881948265e-11);
    const V half = hn::Mul(z, c(0.5));
    const V w = hn::Sub(c(1.0), half);
    const V rest = hn::Sub(hn::Sub(c(1.0), w), half);
    const V k = hn::Add(w, hn::MulAdd(hn::Mul(z, z), c_poly, rest));
    // Quadrant q = n mod 4: odd swaps sine and cosine; 2, 3 negate the sine; 1, 2 the cosine.
    const V q = hn::NegMulAdd(hn::Floor(hn::Mul(n, c(0.25))), c(4.0), n);
    const auto odd = hn::Or(hn::Eq(q, c(1.0)), hn::Eq(q, c(3.0)));
    const V sine_size = hn::IfThenElse(odd, k, s);
    const V cosine_size = hn::IfThenElse(odd, s, k);
    const auto flip_sine = hn::Ge(q, c(2.0));
    const auto flip_cosine = hn::Or(hn::Eq(q, c(1.0)), hn::Eq(q, c(2.0)));
    hn::StoreU(hn::IfThenElse(flip_sine, hn::Neg(sine_size), sine_size), d, out_sine);
    hn::StoreU(hn::IfThenElse(flip_cosine, hn::Neg(cosine_size), cosine_size), d, out_cosine);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) one_vector(angle + i, sine + i, cosine + i);
  if (i == count) return;
  double in[HWY_MAX_BYTES / sizeof(double)] = {};
  double out_sine[HWY_MAX_BYTES / sizeof(double)], out_cosine[HWY_MAX_BYTES / sizeof(double)];
  for (std::size_t j = i; j < count; ++j) in[j - i] = angle[j];
  one_vector(in, out_sine, out_cosine);
  for (std::size_t j = i; j < count; ++j) sine[j] = out_sine[j - i], cosine[j] = out_cosine[j - i];
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(sincos_block);

void sincos(std::span<const double> angle_rad, std::span<double> sine, std::span<double> cosine) {
  expects(angle_rad.size() == sine.size() && sine.size() == cosine.size(),
          "three columns of one length");
  HWY_DYNAMIC_DISPATCH(sincos_block)
  (angle_rad.data(), angle_rad.size(), sine.data(), cosine.data());
}

}  // namespace trueaxis
#endif
