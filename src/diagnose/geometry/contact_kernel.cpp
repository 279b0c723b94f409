// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/contact_kernel.hpp"

#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "diagnose/geometry/contact_kernel.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After highway.h, as it is compiled once for every instruction set too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::diagnose_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kernel_room>;

// The names and steps of `intersect` (src/surface/axis.cpp).
bool meet_all(const Revolved& shape, Root root, const ProbeLines& lines, std::size_t count) {
  const Tag tag;
  const auto set = [&](double value) { return hn::Set(tag, value); };
  const Axis& axis = shape.axis;
  const double secant = std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
  const auto dx = set(axis.slope_x / secant), dy = set(axis.slope_y / secant),
             dz = set(1.0 / secant);
  const auto t = set(shape.tan_half_angle), one = set(1.0), zero = set(0.0);
  const auto height = set(lines.height_mm);
  const auto one_t2 = set(1.0 + shape.tan_half_angle * shape.tan_half_angle);
  bool all = true;
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const auto cosine = hn::LoadU(tag, lines.cosine + i), sine = hn::LoadU(tag, lines.sine + i);
    const auto lever = hn::Sub(hn::LoadU(tag, lines.z + i), set(axis.z_ref_mm));
    const auto qx =
        hn::NegMulSub(height, sine, hn::MulAdd(set(axis.slope_x), lever, set(axis.x_mm)));
    const auto qy =
        hn::MulSub(height, cosine, hn::MulAdd(set(axis.slope_y), lever, set(axis.y_mm)));
    const auto radius = hn::MulAdd(hn::Mul(t, set(secant)), lever, set(shape.radius_mm));
    const auto s0 = hn::MulAdd(qx, dx, hn::Mul(qy, dy));
    const auto g = hn::MulAdd(cosine, dx, hn::Mul(sine, dy));
    const auto r0 = hn::MulAdd(t, s0, radius), tg = hn::Mul(t, g);
    const auto ax = hn::NegMulAdd(s0, dx, qx), ay = hn::NegMulAdd(s0, dy, qy),
               az = hn::Neg(hn::Mul(s0, dz));
    const auto distance = hn::Sqrt(hn::MulAdd(ax, ax, hn::MulAdd(ay, ay, hn::Mul(az, az))));
    const auto a = hn::NegMulAdd(hn::Mul(g, g), one_t2, one);
    const auto b = hn::NegMulAdd(tg, r0, hn::MulAdd(cosine, ax, hn::Mul(sine, ay)));
    const auto c = hn::Mul(hn::Sub(distance, r0), hn::Add(distance, r0));
    const auto discriminant = hn::NegMulAdd(a, c, hn::Mul(b, b));
    const auto size = hn::Sqrt(hn::Max(discriminant, zero));
    const auto stable = hn::Neg(hn::Add(b, hn::CopySign(size, b)));
    const auto first = hn::Div(stable, a), second = hn::Div(c, stable);
    const auto is_met = [&](const auto& x) {
      return hn::And(hn::Lt(hn::Abs(x), set(1e300)), hn::Gt(hn::MulAdd(tg, x, r0), zero));
    };
    const auto one_met = is_met(first), other_met = is_met(second);
    const auto farther = root == Root::front ? hn::Max(first, second) : hn::Min(first, second);
    const auto x = hn::IfThenElse(hn::And(one_met, other_met), farther,
                                  hn::IfThenElse(one_met, first, second));
    const auto met = hn::And(hn::Gt(discriminant, zero), hn::Or(one_met, other_met));
    all = all && hn::AllTrue(tag, hn::Or(met, hn::Not(hn::FirstN(tag, count - i))));
    // G: half the gradient of |q|² − s² − r² at the contact.
    const auto s = hn::MulAdd(g, x, s0), r = hn::MulAdd(tg, x, r0);
    const auto away = hn::MulAdd(t, r, s);
    const auto gx = hn::NegMulAdd(away, dx, hn::MulAdd(x, cosine, qx)),
               gy = hn::NegMulAdd(away, dy, hn::MulAdd(x, sine, qy)),
               gz = hn::Neg(hn::Mul(away, dz));
    const auto inverse = hn::Div(one, hn::MulAdd(cosine, gx, hn::Mul(sine, gy)));
    const auto turned = hn::MulSub(x, hn::MulSub(cosine, gy, hn::Mul(sine, gx)),
                                   hn::Mul(height, hn::MulAdd(cosine, gx, hn::Mul(sine, gy))));
    hn::StoreU(x, tag, lines.x + i);
    hn::StoreU(hn::Neg(hn::Mul(gz, inverse)), tag, lines.dx_dz + i);
    hn::StoreU(hn::Neg(hn::Mul(turned, inverse)), tag, lines.dx_dc + i);
  }
  return all;
}

void all_to_part_frame(const Axis& axis, const TurnedPoints& points, std::size_t count) {
  const Tag tag;
  const auto set = [&](double value) { return hn::Set(tag, value); };
  const double secant = std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
  const double l_of = axis.slope_x / secant, m_of = axis.slope_y / secant;
  const double sine_of = std::hypot(l_of, m_of);
  const auto origin = axis.at(0.0);
  const auto l = set(l_of), m = set(m_of), n = set(1.0 / secant), zero = set(0.0),
             across = set(points.y);
  const auto kx = set(sine_of > 0.0 ? m_of / sine_of : 0.0),
             ky = set(sine_of > 0.0 ? -l_of / sine_of : 0.0), less = set(1.0 - 1.0 / secant);
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const auto at = hn::LoadU(tag, points.x + i), z = hn::LoadU(tag, points.z + i);
    const auto cosine = hn::LoadU(tag, points.cosine + i), sine = hn::LoadU(tag, points.sine + i);
    const auto qx = hn::NegMulAdd(across, sine, hn::MulSub(at, cosine, set(origin[0]))),
               qy = hn::MulAdd(across, cosine, hn::MulSub(at, sine, set(origin[1])));
    const auto along = hn::Mul(hn::MulAdd(kx, qx, hn::Mul(ky, qy)), less);
    const auto x = hn::MulAdd(qx, n, hn::NegMulAdd(l, z, hn::Mul(kx, along))),
               y = hn::MulAdd(qy, n, hn::NegMulAdd(m, z, hn::Mul(ky, along)));
    const auto from = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
    const auto turn = hn::CopySign(set(std::numbers::pi), y);
    const auto angle = hn::Atan(tag, hn::Div(y, x));
    const auto theta = hn::IfThenElse(hn::Lt(x, zero), hn::Add(angle, turn), angle);
    hn::StoreU(hn::IfThenElseZero(hn::Gt(from, zero), theta), tag, points.theta + i);
    hn::StoreU(hn::MulAdd(l, qx, hn::MulAdd(m, qy, hn::Mul(n, z))), tag, points.along + i);
    hn::StoreU(from, tag, points.from + i);
  }
}

}  // namespace trueaxis::diagnose_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis::diagnose_detail {

HWY_EXPORT(meet_all);
HWY_EXPORT(all_to_part_frame);

bool meet(const Revolved& shape, Root root, const ProbeLines& lines, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(meet_all)(shape, root, lines, count);
}

void to_part_frame(const Axis& axis, const TurnedPoints& points, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(all_to_part_frame)(axis, points, count);
}

}  // namespace trueaxis::diagnose_detail
#endif
