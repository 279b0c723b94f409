// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "simulate/geometry.hpp"

namespace trueaxis::virtual_lathe {

/// Root of f in [low, high], f(low) < 0 < f(high), to the last bit or two.
template <class F>
double root_between(const F& f, double low, double f_low, double high, double f_high) {
  std::uintmax_t steps = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      f, low, high, f_low, f_high, boost::math::tools::eps_tolerance<double>(53), steps);
  return 0.5 * (a + b);
}

/// Fast path: two secant steps from `guess`, then a bracket around them that grows. If f is convex,
/// a change from − to + is the outer root, wherever it was found.
template <class F>
std::optional<double> root_near(const F& f, double guess) {
  double x0 = guess, f0 = f(x0);
  double x1 = x0 - f0, f1 = f(x1);
  if (f1 != f0) {
    const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    if (std::abs(x2 - guess) < 4.0 * std::abs(f0) + 1.0) x1 = x2, f1 = f(x1);
  }
  if (f1 == 0.0) return x1;
  double width = 4.0 * std::abs(f1) + 1e-13 * std::max(1.0, std::abs(x1));
  for (int grown = 0; grown < 8; ++grown, width *= 16.0) {
    const double other = f1 > 0.0 ? x1 - width : x1 + width;
    const double f_other = f(other);
    if (f1 > 0.0 && f_other < 0.0) return root_between(f, other, f_other, x1, f1);
    if (f1 < 0.0 && f_other > 0.0) return root_between(f, x1, f1, other, f_other);
  }
  return std::nullopt;
}

/// Sure path for a surface of revolution about an axis near q = centre: down to the least gap, then
/// out to the wall. Nothing when the line passes the surface by.
template <class F>
std::optional<double> root_outside(const F& f, double centre, double reach) {
  std::uintmax_t steps = 200;
  const auto [least, f_least] =
      boost::math::tools::brent_find_minima(f, centre - reach, centre + reach, 40, steps);
  if (!(f_least < 0.0)) return std::nullopt;
  double high = centre + reach, f_high = f(high);
  for (int grown = 0; grown < 60 && !(f_high > 0.0); ++grown) {
    high = least + 2.0 * (high - least);
    f_high = f(high);
  }
  if (!(f_high > 0.0)) return std::nullopt;
  return root_between(f, least, f_least, high, f_high);
}

/// A form with edges: from 0.5 mm outside `ideal` inwards in small steps to the first material.
template <class F>
std::optional<double> root_from_outside(const F& f, double ideal, double depth_limit) {
  constexpr double step = 0.01;
  double high = ideal + 0.5, f_high = f(high);
  while (!(f_high > 0.0)) {
    if (!(high <= ideal + depth_limit)) return std::nullopt;
    high += 0.5;
    f_high = f(high);
  }
  while (high > ideal - depth_limit) {
    const double low = high - step, f_low = f(low);
    if (f_low <= 0.0) return root_between(f, low, f_low, high, f_high);
    high = low;
    f_high = f_low;
  }
  return std::nullopt;
}

/// Unit gradient of a gap, by central differences; errors of it enter a contact to second order.
template <class Gap>
Vec3 normal_at(const Gap& gap, const Vec3& p) {
  constexpr double h = 1e-4;
  const Vec3 g{gap({p.x + h, p.y, p.z}) - gap({p.x - h, p.y, p.z}),
               gap({p.x, p.y + h, p.z}) - gap({p.x, p.y - h, p.z}),
               gap({p.x, p.y, p.z + h}) - gap({p.x, p.y, p.z - h})};
  return unit(g);
}

/// Reading of a ball: the centre is off the contact by the radius along the normal, outwards of
/// the material (`stand_off` > 0) or inwards of a bore (< 0). `point_reading(line)` finds the
/// contact of a point on a line. With `aside` the centre keeps over the contact along it.
template <class Gap, class PointReading>
std::pair<std::optional<double>, Vec3> settled_ball(const Gap& gap, const Line& line,
                                                    double stand_off, const Vec3& aside,
                                                    const PointReading& point_reading) {
  std::optional<double> q = point_reading(line);
  Vec3 offset;
  for (int step = 0; q && step < 200; ++step) {
    const Vec3 normal = normal_at(gap, line.at(*q) + offset);
    const Vec3 next = (-stand_off) * unit(normal - dot(normal, aside) * aside);
    const Vec3 moved = next - offset;
    offset = next;
    q = point_reading(Line{line.base + offset, line.direction});
    if (dot(moved, moved) < 1e-18) break;  // 1 nm aside on the surface: 1e-14 mm in the reading
  }
  return {q, offset};
}

/// Waves of a surface along a unit vector, and how far off a ball may touch them.
struct Crests {
  Vec3 along;
  double reach_mm = 0.0, step_mm = 0.0;
};

/// Reading of a ball that may touch waves in several places, because they bend more than it does:
/// the first that stops it, of all places within reach.
template <class Gap, class PointReading>
std::optional<double> reading_on_crests(const Gap& gap, const Line& line, double stand_off,
                                        const Crests& crests, const PointReading& point_reading) {
  const auto [over, ahead] = settled_ball(gap, line, stand_off, crests.along, point_reading);
  if (!over) return std::nullopt;
  const double r = std::abs(stand_off), sign = std::copysign(1.0, -stand_off);
  const auto stop = [&, ahead = ahead](double s) {  // the less, the earlier it stops
    const Vec3 at = s * crests.along + std::sqrt(1.0 - s * s / (r * r)) * ahead;
    const std::optional<double> q = point_reading(Line{line.base + at, line.direction});
    return q ? sign * *q : std::numeric_limits<double>::infinity();
  };
  double best = 0.0, least = sign * *over;
  for (double s = -crests.reach_mm; s <= crests.reach_mm; s += crests.step_mm) {
    if (const double q = stop(s); q < least) best = s, least = q;
  }
  const double low = best - crests.step_mm, high = best + crests.step_mm;
  return sign * boost::math::tools::brent_find_minima(stop, low, high, 26).second;
}

}  // namespace trueaxis::virtual_lathe
