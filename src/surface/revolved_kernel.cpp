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

// 1/√x and 1/x to the last bit or two: a single-precision estimate (at least 11 bits), one step of
// third order (33 bits) and one of second. Division and square root in double would take longer
// than all the rest.
template <class D, class V>
HWY_INLINE V inverse_root(D tag, V x) {
  const hn::Rebind<float, D> single;
  V y = hn::PromoteTo(tag, hn::ApproximateReciprocalSqrt(hn::DemoteTo(single, x)));
  V e = hn::NegMulAdd(x, hn::Mul(y, y), hn::Set(tag, 1.0));
  y = hn::MulAdd(hn::Mul(y, e), hn::MulAdd(e, hn::Set(tag, 0.375), hn::Set(tag, 0.5)), y);
  e = hn::NegMulAdd(x, hn::Mul(y, y), hn::Set(tag, 1.0));
  return hn::MulAdd(hn::Mul(y, e), hn::Set(tag, 0.5), y);
}

template <class D, class V>
HWY_INLINE V inverse(D tag, V x) {
  const hn::Rebind<float, D> single;
  V y = hn::PromoteTo(tag, hn::ApproximateReciprocal(hn::DemoteTo(single, x)));
  V e = hn::NegMulAdd(x, y, hn::Set(tag, 1.0));
  y = hn::MulAdd(hn::Mul(y, e), hn::Add(e, hn::Set(tag, 1.0)), y);
  e = hn::NegMulAdd(x, y, hn::Set(tag, 1.0));
  return hn::MulAdd(y, e, y);
}

// Let e = (cos C, sin C, 0), q = (X cos C − x, X sin C − y, ζ) and ζ = Z − z_ref. With d the unit
// axis, g = e·d, s = s0 + g X, r = r_ref + t s, K = 1 + t²: A X² + 2 B X + F = 0, A = 1 − K g², B =
// e·q0 − g (K s0 + t r_ref), F = |q0|² − s0² − (r_ref + t s0)², √disc = √(B² − A F) = e·G. Three
// stages over the block, as one chain of dependent steps is too long for a processor to overlap
// with enough of its neighbours.
struct Constants {
  double x, y, dx, dy, dz, z_ref, s_origin, offset2, k, t, r_ref;
};

struct Stages {
  alignas(64) double g[block_size], s0[block_size], a[block_size], b[block_size], disc[block_size];
  alignas(64) double w[block_size], x[block_size];
};

using Tag = hn::CappedTag<double, block_size>;
using V = hn::Vec<Tag>;

HWY_INLINE void discriminants(const Constants& of, const ReadingBlock& readings, Stages& stages) {
  const Tag tag;
  const auto set = [&](double value) { return hn::Set(tag, value); };
  const V ax = set(of.x), ay = set(of.y), dx = set(of.dx), dy = set(of.dy), dz = set(of.dz);
  const V z_ref = set(of.z_ref), s_origin = set(of.s_origin), offset2 = set(of.offset2);
  const V k = set(of.k), t = set(of.t), r_ref = set(of.r_ref), t_r_ref = set(of.t * of.r_ref);
  for (std::size_t i = 0; i < block_size; i += hn::Lanes(tag)) {
    const V c = hn::LoadU(tag, readings.cos_c + i), sn = hn::LoadU(tag, readings.sin_c + i);
    const V zeta = hn::Sub(hn::LoadU(tag, readings.position_mm + i), z_ref);
    const V g = hn::MulAdd(dx, c, hn::Mul(dy, sn));
    const V s0 = hn::MulAdd(dz, zeta, s_origin);
    const V r0 = hn::MulAdd(t, s0, r_ref);
    const V kappa0 = hn::MulAdd(k, s0, t_r_ref);  // s0 + t r0
    const V a = hn::NegMulAdd(hn::Mul(k, g), g, set(1.0));
    const V b = hn::NegMulAdd(ax, c, hn::NegMulAdd(ay, sn, hn::Neg(hn::Mul(g, kappa0))));
    const V f = hn::NegMulAdd(r0, r0, hn::NegMulAdd(s0, s0, hn::MulAdd(zeta, zeta, offset2)));
    hn::Store(g, tag, stages.g + i);
    hn::Store(s0, tag, stages.s0 + i);
    hn::Store(a, tag, stages.a + i);
    hn::Store(b, tag, stages.b + i);
    hn::Store(hn::NegMulAdd(a, f, hn::Mul(b, b)), tag, stages.disc + i);
  }
}

/// X of the root on `side` and w = 1/(e·G). @returns the least disc and A: a line misses where one
/// is not positive.
HWY_INLINE V roots(double side, Stages& stages) {
  const Tag tag;
  const V half = hn::Set(tag, 0.5), sign = hn::Set(tag, side);
  V worst = hn::Set(tag, 1.0);
  for (std::size_t i = 0; i < block_size; i += hn::Lanes(tag)) {
    const V disc = hn::Load(tag, stages.disc + i), a = hn::Load(tag, stages.a + i);
    const V safe = hn::Max(disc, hn::Set(tag, 1e-12));
    const V w = inverse_root(tag, safe);
    const V estimate = hn::Mul(safe, w);
    const V rest = hn::NegMulAdd(estimate, estimate, safe);
    const V root = hn::Mul(sign, hn::MulAdd(hn::Mul(rest, half), w, estimate));
    const V x = hn::Mul(hn::Sub(root, hn::Load(tag, stages.b + i)), inverse(tag, a));
    worst = hn::Min(worst, hn::Min(disc, a));
    hn::Store(hn::Mul(sign, w), tag, stages.w + i);
    hn::Store(x, tag, stages.x + i);
  }
  return worst;
}

/// Residuals and columns. @returns the least radius: below zero a line meets the mirrored nappe.
HWY_INLINE V basis(const Constants& of, double offset_mm, const ReadingBlock& readings,
                   const Stages& stages, PredictionBlock& out) {
  const Tag tag;
  const auto set = [&](double value) { return hn::Set(tag, value); };
  const V ax = set(of.x), ay = set(of.y), dx = set(of.dx), dy = set(of.dy);
  const V k = set(of.k), t = set(of.t), r_ref = set(of.r_ref), t_r_ref = set(of.t * of.r_ref);
  const V offset = set(offset_mm);
  V worst = set(1.0);
  for (std::size_t i = 0; i < block_size; i += hn::Lanes(tag)) {
    const V c = hn::LoadU(tag, readings.cos_c + i), sn = hn::LoadU(tag, readings.sin_c + i);
    const V x = hn::Load(tag, stages.x + i), w = hn::Load(tag, stages.w + i);
    const V s = hn::MulAdd(hn::Load(tag, stages.g + i), x, hn::Load(tag, stages.s0 + i));
    const V r = hn::MulAdd(t, s, r_ref);
    const V kappa = hn::MulAdd(k, s, t_r_ref);
    worst = hn::Min(worst, r);
    const V gx = hn::Mul(w, hn::NegMulAdd(dx, kappa, hn::MulSub(x, c, ax)));
    const V gy = hn::Mul(w, hn::NegMulAdd(dy, kappa, hn::MulSub(x, sn, ay)));
    const V wr = hn::Mul(w, r);
    const V reading = hn::LoadU(tag, readings.reading_mm + i);
    hn::Store(hn::Sub(hn::Sub(reading, offset), x), tag, out.residual + i);
    hn::Store(gx, tag, out.column[w_gx] + i);
    hn::Store(gy, tag, out.column[w_gy] + i);
    hn::Store(hn::Mul(s, gx), tag, out.column[w_s_gx] + i);
    hn::Store(hn::Mul(s, gy), tag, out.column[w_s_gy] + i);
    hn::Store(wr, tag, out.column[w_r] + i);
    hn::Store(hn::Mul(s, wr), tag, out.column[w_r_s] + i);
  }
  return worst;
}

void revolved_block(const Revolved& surface, double side, double offset_mm,
                    const ReadingBlock& readings, PredictionBlock& out) {
  const Axis& axis = surface.axis;
  const double t = surface.tan_half_angle;
  const double n = 1.0 / std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
  const double dx = axis.slope_x * n, dy = axis.slope_y * n;
  const Constants of{axis.x_mm,
                     axis.y_mm,
                     dx,
                     dy,
                     n,
                     axis.z_ref_mm,
                     -dx * axis.x_mm - dy * axis.y_mm,
                     axis.x_mm * axis.x_mm + axis.y_mm * axis.y_mm,
                     1.0 + t * t,
                     t,
                     surface.radius_mm};
  Stages stages;
  discriminants(of, readings, stages);
  const V missed = roots(side, stages);
  const V mirrored = basis(of, offset_mm, readings, stages, out);
  out.valid = hn::GetLane(hn::MinOfLanes(Tag(), hn::Min(missed, mirrored))) > 0.0;
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
