// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/machine/control.hpp"

namespace trueaxis::virtual_machine {
namespace {

using Complex = std::complex<double>;

/// On the left of the way from start to end for G3 and less than half a turn.
std::optional<Complex> centre_by_radius(double radius_mm, bool clockwise, Complex from,
                                        Complex to) {
  const Complex half = 0.5 * (to - from);
  if (half == 0.0 || radius_mm == 0.0) return std::nullopt;
  const double over = radius_mm * radius_mm / std::norm(half) - 1.0;
  if (over < -1e-3) return std::nullopt;
  const double side = clockwise == (radius_mm > 0.0) ? -1.0 : 1.0;
  return from + half * Complex(1.0, side * std::sqrt(std::fmax(over, 0.0)));
}

}  // namespace

Vector3 ArcWay::put_on_arc(Vector3 even, const Vector3& from, const Vector3& to,
                           double share) const {
  const Complex start = in_plane(from) - centre_mm, end = in_plane(to) - centre_mm;
  const double radius_mm = std::lerp(std::abs(start), std::abs(end), share);
  const Complex there = centre_mm + std::polar(radius_mm, std::arg(start) + share * turn_rad);
  even[first] = there.real();
  even[second] = there.imag();
  return even;
}

double ArcWay::length_mm(const Vector3& from) const {
  return std::abs(turn_rad) * std::abs(in_plane(from) - centre_mm);
}

std::optional<ArcWay> arc_of(const BlockWords& block, double unit_mm, int plane, bool clockwise,
                             const Vector3& from, const Vector3& to) {
  ArcWay arc;
  arc.first = plane == 17 ? 0 : plane == 18 ? 2 : 1;
  arc.second = plane == 17 ? 1 : plane == 18 ? 0 : 2;
  const Complex start = arc.in_plane(from), end = arc.in_plane(to);
  const char in_first = "IJK"[arc.first], in_second = "IJK"[arc.second];
  if (block.has('R')) {
    const auto centre = centre_by_radius(unit_mm * block.of_letter.at('R'), clockwise, start, end);
    if (!centre) return std::nullopt;
    arc.centre_mm = *centre;
  } else {
    const double i = block.has(in_first) ? block.of_letter.at(in_first) : 0.0,
                 j = block.has(in_second) ? block.of_letter.at(in_second) : 0.0;
    if (i == 0.0 && j == 0.0) return std::nullopt;
    arc.centre_mm = start + unit_mm * Complex(i, j);
  }
  arc.turn_rad = std::arg((end - arc.centre_mm) / (start - arc.centre_mm));
  constexpr double nothing = 1e-9, whole = 2.0 * std::numbers::pi;
  if (!clockwise && arc.turn_rad < nothing) arc.turn_rad += whole;
  if (clockwise && arc.turn_rad > -nothing) arc.turn_rad -= whole;
  return arc;
}

}  // namespace trueaxis::virtual_machine
