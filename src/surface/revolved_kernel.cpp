// SPDX-License-Identifier: Apache-2.0
#include "surface/revolved_kernel.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surface/revolved_kernel.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// With e = (cos C, sin C, 0), q = (X cos C − x, X sin C − y, ζ), ζ = Z − z_ref, d the unit axis, g
// = e·d, s = s0 + g X, r = r_ref + t s, K = 1 + t²:   A X² + 2 B X + F = 0, A = 1 − K g²,  B = e·q0
// − g (K s0 + t r_ref),  F = |q0|² − s0² − (r_ref + t s0)²,  √disc = √(B² − A F) = e·G.
void revolved_block(const Revolved& surface, double side, double offset_mm,
                    const ReadingBlock& readings, PredictionBlock& out) {
  const hn::CappedTag<double, block_size> tag;
  using V = hn::Vec<decltype(tag)>;
  const auto set = [&](double value) { return hn::Set(tag, value); };
  const double bx = surface.axis.slope_x, by = surface.axis.slope_y, t = surface.tan_half_angle;
  const double inverse_length = 1.0 / std::sqrt(1.0 + bx * bx + by * by);
  const double dx_ = bx * inverse_length, dy_ = by * inverse_length;
  const V ax = set(surface.axis.x_mm), ay = set(surface.axis.y_mm),
          z_ref = set(surface.axis.z_ref_mm);
  const V dx = set(dx_), dy = set(dy_), dz = set(inverse_length);
  const V s_origin = set(-dx_ * surface.axis.x_mm - dy_ * surface.axis.y_mm);
  const V offset2 =
      set(surface.axis.x_mm * surface.axis.x_mm + surface.axis.y_mm * surface.axis.y_mm);
  const V k = set(1.0 + t * t), tan = set(t), r_ref = set(surface.radius_mm);
  const V t_r_ref = set(t * surface.radius_mm), one = set(1.0), sign = set(side),
          offset = set(offset_mm);
  V worst = set(1.0);

  for (std::size_t i = 0; i < block_size; i += hn::Lanes(tag)) {
    const V c = hn::LoadU(tag, readings.cos_c + i), sn = hn::LoadU(tag, readings.sin_c + i);
    const V zeta = hn::Sub(hn::LoadU(tag, readings.position_mm + i), z_ref);
    const V g = hn::MulAdd(dx, c, hn::Mul(dy, sn));
    const V s0 = hn::MulAdd(dz, zeta, s_origin);
    const V r0 = hn::MulAdd(tan, s0, r_ref);
    const V kappa0 = hn::MulAdd(k, s0, t_r_ref);  // s0 + t r0
    const V a = hn::NegMulAdd(hn::Mul(k, g), g, one);
    const V b = hn::NegMulAdd(ax, c, hn::NegMulAdd(ay, sn, hn::Neg(hn::Mul(g, kappa0))));
    const V f = hn::NegMulAdd(r0, r0, hn::NegMulAdd(s0, s0, hn::MulAdd(zeta, zeta, offset2)));
    const V disc = hn::NegMulAdd(a, f, hn::Mul(b, b));
    const V safe = hn::Max(disc, set(1e-12));
    const V root = hn::Mul(sign, hn::Sqrt(safe));
    const V inverse = hn::Div(one, hn::Mul(a, root));
    const V w = hn::Mul(a, inverse);
    const V x = hn::Mul(hn::Sub(root, b), hn::Mul(root, inverse));
    const V s = hn::MulAdd(g, x, s0);
    const V r = hn::MulAdd(tan, s, r_ref);
    const V kappa = hn::MulAdd(k, s, t_r_ref);
    worst = hn::Min(worst, hn::Min(disc, hn::Min(r, a)));
    const V gx = hn::Mul(w, hn::NegMulAdd(dx, kappa, hn::MulSub(x, c, ax)));
    const V gy = hn::Mul(w, hn::NegMulAdd(dy, kappa, hn::MulSub(x, sn, ay)));
    const V wr = hn::Mul(w, r);
    hn::StoreU(hn::Sub(hn::Sub(hn::LoadU(tag, readings.reading_mm + i), offset), x), tag,
               out.residual + i);
    hn::StoreU(gx, tag, out.column[w_gx] + i);
    hn::StoreU(gy, tag, out.column[w_gy] + i);
    hn::StoreU(hn::Mul(s, gx), tag, out.column[w_s_gx] + i);
    hn::StoreU(hn::Mul(s, gy), tag, out.column[w_s_gy] + i);
    hn::StoreU(wr, tag, out.column[w_r] + i);
    hn::StoreU(hn::Mul(s, wr), tag, out.column[w_r_s] + i);
  }
  out.valid = hn::GetLane(hn::MinOfLanes(tag, worst)) > 0.0;
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(revolved_block);

void evaluate_revolved(const Revolved& surface, Root root, double offset_mm,
                       const ReadingBlock& readings, PredictionBlock& out) {
  HWY_DYNAMIC_DISPATCH(revolved_block)
  (surface, root == Root::front ? 1.0 : -1.0, offset_mm, readings, out);
}

}  // namespace trueaxis
#endif
