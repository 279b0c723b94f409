// SPDX-License-Identifier: Apache-2.0
#include "associate/distance_kernel.hpp"

#include <algorithm>
#include <cmath>

#ifndef TRUEAXIS_KERNEL_PLACE
#define TRUEAXIS_KERNEL_PLACE
namespace trueaxis {
/// `Placed` in numbers that need no Eigen: what is compiled for several instruction sets must not
/// make functions that others use.
struct KernelPlace {
  Shape shape;
  double base[3] = {}, offset[3] = {}, axes[9] = {};
  double size = 0.0, second_size = 0.0, cosine = 1.0, sine = 0.0;
};
}  // namespace trueaxis
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "associate/distance_kernel.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, block_size>;
using V = hn::Vec<Tag>;

HWY_INLINE V set(double value) { return hn::Set(Tag(), value); }

struct Local {
  V x, y, z;
};

/// Points of the world in the frame of the element: base first, which is exact near the points.
HWY_INLINE Local local_of(const KernelPlace& of, const double* xyz) {
  V x, y, z;
  hn::LoadInterleaved3(Tag(), xyz, x, y, z);
  x = hn::Sub(hn::Sub(x, set(of.base[0])), set(of.offset[0]));
  y = hn::Sub(hn::Sub(y, set(of.base[1])), set(of.offset[1]));
  z = hn::Sub(hn::Sub(z, set(of.base[2])), set(of.offset[2]));
  const auto row = [&](const double* axis) {
    return hn::MulAdd(set(axis[0]), x, hn::MulAdd(set(axis[1]), y, hn::Mul(set(axis[2]), z)));
  };
  return {row(of.axes), row(of.axes + 3), row(of.axes + 6)};
}

HWY_INLINE V length(V a, V b) { return hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b))); }
HWY_INLINE V over(V a, V length) { return hn::Div(a, hn::Max(length, set(1e-300))); }

/// Where a column goes: nowhere, or into a block.
struct Columns {
  DistanceBlock* block;
  std::size_t at, next = 0;
  HWY_INLINE void add(V value) { hn::Store(value, Tag(), block->column[next++] + at); }
};

/// d (Eq. 242); its derivatives go to `to` where WithJacobian.
template <Shape shape, bool WithJacobian>
HWY_INLINE V distance(const KernelPlace& of, const Local& q, Columns& to) {
  const auto jacobian = [&](auto... columns) {
    if constexpr (WithJacobian) (to.add(columns), ...);
  };
  const V minus_one = set(-1.0);
  if constexpr (shape == Shape::line_2d) {
    jacobian(minus_one, hn::Neg(q.z));
    return q.x;
  } else if constexpr (shape == Shape::plane) {
    jacobian(minus_one, q.x, q.y);
    return q.z;
  } else if constexpr (shape == Shape::sphere) {
    const V r = hn::Sqrt(hn::MulAdd(q.x, q.x, hn::MulAdd(q.y, q.y, hn::Mul(q.z, q.z))));
    if constexpr (WithJacobian)
      jacobian(hn::Neg(over(q.x, r)), hn::Neg(over(q.y, r)), hn::Neg(over(q.z, r)), minus_one);
    return hn::Sub(r, set(of.size));
  } else {
    const V rho = length(q.x, q.y);
    V ux = rho, uy = rho;
    if constexpr (WithJacobian) ux = hn::Neg(over(q.x, rho)), uy = hn::Neg(over(q.y, rho));
    if constexpr (shape == Shape::circle_2d) {
      jacobian(ux, uy, minus_one);
      return hn::Sub(rho, set(of.size));
    } else if constexpr (shape == Shape::line_3d || shape == Shape::cylinder) {
      if constexpr (WithJacobian) jacobian(ux, uy, hn::Mul(ux, q.z), hn::Mul(uy, q.z));
      if constexpr (shape == Shape::line_3d) return rho;
      jacobian(minus_one);
      return hn::Sub(rho, set(of.size));
    } else if constexpr (shape == Shape::cone) {
      const V c = set(of.cosine), s = set(of.sine);
      if constexpr (WithJacobian)
        jacobian(hn::Mul(c, ux), hn::Mul(c, uy), hn::MulSub(hn::Mul(c, ux), q.z, hn::Mul(s, q.x)),
                 hn::MulSub(hn::Mul(c, uy), q.z, hn::Mul(s, q.y)), minus_one,
                 hn::Neg(hn::MulAdd(rho, s, hn::Mul(q.z, c))));
      return hn::Sub(hn::MulSub(rho, c, hn::Mul(q.z, s)), set(of.size));
    } else {  // a circle in space and the tube about it
      const V out = hn::Sub(rho, set(of.size)), f = length(out, q.z);
      if constexpr (WithJacobian) {
        const V e = over(out, f), k = over(q.z, f), eu = hn::Mul(e, ux), ev = hn::Mul(e, uy);
        jacobian(eu, ev, hn::Neg(k), hn::MulAdd(eu, q.z, hn::Mul(k, q.x)),
                 hn::MulAdd(ev, q.z, hn::Mul(k, q.y)), hn::Neg(e));
      }
      if constexpr (shape == Shape::circle_3d) return f;
      jacobian(minus_one);
      return hn::Sub(f, set(of.second_size));
    }
  }
}

/// Both components of a line or circle in space with their derivatives.
template <Shape shape>
HWY_INLINE void components(const KernelPlace& of, const Local& q, Columns& first, Columns& second) {
  const V zero = hn::Zero(Tag()), minus_one = set(-1.0);
  const auto all = [](Columns& to, auto... columns) { (to.add(columns), ...); };
  if constexpr (shape == Shape::line_3d) {
    all(first, minus_one, zero, hn::Neg(q.z), zero, q.x);
    all(second, zero, minus_one, zero, hn::Neg(q.z), q.y);
  } else {
    const V rho = length(q.x, q.y), ux = hn::Neg(over(q.x, rho)), uy = hn::Neg(over(q.y, rho));
    all(first, ux, uy, zero, hn::Mul(ux, q.z), hn::Mul(uy, q.z), minus_one,
        hn::Sub(rho, set(of.size)));
    all(second, zero, zero, minus_one, q.x, q.y, zero, q.z);
  }
}

template <Shape shape>
void distances_of(const KernelPlace& of, const double* xyz, double* out) {
  const Tag tag;
  for (std::size_t at = 0; at < block_size; at += hn::Lanes(tag)) {
    Columns none{nullptr, at};
    hn::StoreU(distance<shape, false>(of, local_of(of, xyz + 3 * at), none), tag, out + at);
  }
}

template <Shape shape>
void jacobian_of(const KernelPlace& of, const double* xyz, DistanceBlock* block, bool apart) {
  const Tag tag;
  for (std::size_t at = 0; at < block_size; at += hn::Lanes(tag)) {
    Columns first{block, at}, second{block + (apart ? 1 : 0), at};
    const Local q = local_of(of, xyz + 3 * at);
    if constexpr (shape == Shape::line_3d || shape == Shape::circle_3d) {
      if (apart) {
        components<shape>(of, q, first, second);
        continue;
      }
    }
    const V d = distance<shape, true>(of, q, first);
    first.add(d);
  }
}

template <class Call>
HWY_INLINE void with_shape(Shape shape, const Call& call) {
#define TRUEAXIS_CASE(name) \
  case Shape::name:         \
    return call(std::integral_constant<Shape, Shape::name>())
  switch (shape) {
    TRUEAXIS_CASE(line_2d);
    TRUEAXIS_CASE(circle_2d);
    TRUEAXIS_CASE(line_3d);
    TRUEAXIS_CASE(circle_3d);
    TRUEAXIS_CASE(plane);
    TRUEAXIS_CASE(sphere);
    TRUEAXIS_CASE(cylinder);
    TRUEAXIS_CASE(cone);
    TRUEAXIS_CASE(torus);
  }
#undef TRUEAXIS_CASE
}

void only_distances(const KernelPlace& of, const double* xyz, double* out) {
  with_shape(of.shape, [&](auto shape) { distances_of<shape.value>(of, xyz, out); });
}

void jacobian(const KernelPlace& of, const double* xyz, DistanceBlock* block, bool apart) {
  with_shape(of.shape, [&](auto shape) { jacobian_of<shape.value>(of, xyz, block, apart); });
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(only_distances);
HWY_EXPORT(jacobian);

namespace {

KernelPlace kernel_place(const Placed& placed) {
  KernelPlace out{.shape = placed.shape,
                  .size = placed.size,
                  .second_size = placed.second_size,
                  .cosine = std::cos(placed.second_size),
                  .sine = std::sin(placed.second_size)};
  for (Eigen::Index i = 0; i < 3; ++i) {
    out.base[i] = placed.base[static_cast<std::size_t>(i)];
    out.offset[i] = placed.offset[i];
    for (Eigen::Index j = 0; j < 3; ++j) out.axes[3 * i + j] = placed.axes(i, j);
  }
  return out;
}

/// Whole blocks as they are, a part of one filled up with its first point.
template <class Call>
void with_whole_block(std::span<const Point3> points, const Call& call) {
  if (points.size() == block_size) return call(points.data()->data());
  Point3 padded[block_size];
  std::fill(std::ranges::copy(points, padded).out, std::end(padded), points.front());
  call(padded->data());
}

void clear_rest(DistanceBlock& block, std::size_t columns, std::size_t count) {
  for (std::size_t k = 0; k < columns; ++k)
    std::fill(block.column[k] + count, block.column[k] + block_size, 0.0);
}

void jacobian_block(const Placed& placed, std::span<const Point3> points, DistanceBlock* blocks,
                    std::size_t parts) {
  with_whole_block(points, [&](const double* xyz) {
    HWY_DYNAMIC_DISPATCH(jacobian)(kernel_place(placed), xyz, blocks, parts == 2);
  });
  for (std::size_t part = 0; part < parts; ++part)
    clear_rest(blocks[part], traits_of(placed.shape).parameters + 1, points.size());
}

}  // namespace

void evaluate_distances(const Placed& placed, std::span<const Point3> points,
                        DistanceBlock& block) {
  jacobian_block(placed, points, &block, 1);
}

void evaluate_components(const Placed& placed, std::span<const Point3> points,
                         DistanceBlock components[2]) {
  jacobian_block(placed, points, components, traits_of(placed.shape).residuals);
}

void evaluate_only_distances(const Placed& placed, std::span<const Point3> points,
                             double* distance_mm) {
  alignas(64) double distance[block_size];
  with_whole_block(points, [&](const double* xyz) {
    HWY_DYNAMIC_DISPATCH(only_distances)(kernel_place(placed), xyz, distance);
  });
  std::copy_n(distance, points.size(), distance_mm);
}

}  // namespace trueaxis
#endif
