// SPDX-License-Identifier: Apache-2.0
#include "form/axis_line.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <vector>

#include "math/dual_simplex.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {

AxisLine least_squares_line(std::span<const CentrePoint> centres) {
  const double n = static_cast<double>(centres.size());
  double x = 0.0, y = 0.0, z = 0.0, zz = 0.0, zx = 0.0, zy = 0.0;
  for (const CentrePoint& one : centres) {
    x += one.x_mm / n;
    y += one.y_mm / n;
    z += one.z_mm / n;
  }
  for (const CentrePoint& one : centres) {
    zz += (one.z_mm - z) * (one.z_mm - z);
    zx += (one.z_mm - z) * (one.x_mm - x);
    zy += (one.z_mm - z) * (one.y_mm - y);
  }
  AxisLine line;
  line.l = zz > 0.0 ? zx / zz : 0.0;
  line.m = zz > 0.0 ? zy / zz : 0.0;
  line.x0_mm = x - line.l * z;
  line.y0_mm = y - line.m * z;
  return line;
}

namespace {

/// A side of the cylinder: no centre is further than the size off the axis in one direction.
struct Side {
  Unknowns column;
  double cost;
};

/// Unknowns are the size, and where the axis is in the middle and half the length further. There
/// are as many sides as directions, of which the one that is broken most enters.
class Cylinder {
 public:
  explicit Cylinder(std::span<const CentrePoint> centres)
      : centres_(centres), start_(least_squares_line(centres)) {
    const auto [low, high] =
        std::ranges::minmax(centres | std::views::transform(&CentrePoint::z_mm));
    middle_ = 0.5 * (low + high);
    half_ = std::max(0.5 * (high - low), 1e-9);
  }

  static constexpr int unknowns = 5, most_exchanges = 1000;

  std::vector<Side> walls() const {
    double largest = 0.0;
    for (const CentrePoint& one : centres_) largest = std::max(largest, std::hypot(x(one), y(one)));
    std::vector<Side> out;
    for (int k = 0; k < unknowns; ++k)
      out.push_back({Unknowns::Unit(unknowns, k), -wall * largest});
    return out;
  }
  Unknowns column(const Side& side) const { return side.column; }
  double cost(const Side& side) const { return side.cost; }
  std::optional<Side> entering(const Unknowns& at, int) const {
    std::optional<Side> out;
    double most = at[0] + settled * std::abs(at[0]) + least_mm;
    for (const CentrePoint& one : centres_) {
      const double t = (one.z_mm - middle_) / half_;
      const double off_x = x(one) - at[1] - t * at[3], off_y = y(one) - at[2] - t * at[4];
      const double off = std::hypot(off_x, off_y);
      if (off <= most) continue;
      most = off;
      const double c = off_x / off, s = off_y / off;
      out.emplace(Side{Unknowns(unknowns), c * x(one) + s * y(one)});
      out->column << 1.0, c, s, t * c, t * s;
    }
    return out;
  }

 private:
  /// How far off the walls are that the exchange starts from, over the largest distance from the
  /// line of least squares: the axis of the smallest cylinder is at most two of it off at its ends.
  static constexpr double wall = 3.0;
  static constexpr double settled = 1e-12, least_mm = 1e-15;
  double x(const CentrePoint& one) const { return one.x_mm - start_.at(one.z_mm)[0]; }
  double y(const CentrePoint& one) const { return one.y_mm - start_.at(one.z_mm)[1]; }

  std::span<const CentrePoint> centres_;
  AxisLine start_;
  double middle_, half_;
};

}  // namespace

double smallest_cylinder_mm(std::span<const CentrePoint> centres) {
  if (centres.size() < 3) return 0.0;
  Cylinder cylinder(centres);
  std::vector<Side> sides = cylinder.walls();
  const Unknowns size = Unknowns::Unit(Cylinder::unknowns, 0);
  return 2.0 * dual_simplex(size, sides, cylinder, Cylinder::most_exchanges).x[0];
}

namespace {

/// The least circle that holds all points, by those that it rests on (Welzl 1991).
double smallest_circle_mm(std::span<const CentrePoint> points) {
  double x = points[0].x_mm, y = points[0].y_mm, r = 0.0;
  const auto holds = [&](const CentrePoint& one) {
    return std::hypot(one.x_mm - x, one.y_mm - y) <= r * (1.0 + 1e-13);
  };
  const auto over_two = [&](const CentrePoint& a, const CentrePoint& b) {
    x = 0.5 * (a.x_mm + b.x_mm);
    y = 0.5 * (a.y_mm + b.y_mm);
    r = std::hypot(a.x_mm - x, a.y_mm - y);
  };
  const auto over_three = [&](const CentrePoint& a, const CentrePoint& b, const CentrePoint& c) {
    const double bx = b.x_mm - a.x_mm, by = b.y_mm - a.y_mm;
    const double cx = c.x_mm - a.x_mm, cy = c.y_mm - a.y_mm;
    const double twice = 2.0 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    if (twice == 0.0) return;
    const double dx = (cy * b2 - by * c2) / twice, dy = (bx * c2 - cx * b2) / twice;
    x = a.x_mm + dx;
    y = a.y_mm + dy;
    r = std::hypot(dx, dy);
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (holds(points[i])) continue;
    x = points[i].x_mm, y = points[i].y_mm, r = 0.0;
    for (std::size_t j = 0; j < i; ++j) {
      if (holds(points[j])) continue;
      over_two(points[i], points[j]);
      for (std::size_t k = 0; k < j; ++k)
        if (!holds(points[k])) over_three(points[i], points[j], points[k]);
    }
  }
  return 2.0 * r;
}

}  // namespace

double smallest_parallel_cylinder_mm(std::span<const CentrePoint> centres, const AxisLine& datum) {
  std::vector<CentrePoint> sheared(centres.begin(), centres.end());
  for (CentrePoint& one : sheared) {
    one.x_mm -= datum.l * one.z_mm;
    one.y_mm -= datum.m * one.z_mm;
  }
  return sheared.size() < 2 ? 0.0 : smallest_circle_mm(sheared);
}

double coaxiality_mm(std::span<const CentrePoint> centres, const AxisLine& datum) {
  double largest = 0.0;
  const double n2 = 1.0 + datum.l * datum.l + datum.m * datum.m;
  for (const CentrePoint& one : centres) {
    const auto [x, y] = datum.at(one.z_mm);
    const double dx = one.x_mm - x, dy = one.y_mm - y;
    const double along = dx * datum.l + dy * datum.m;
    largest = std::max(largest, std::sqrt(std::max(0.0, dx * dx + dy * dy - along * along / n2)));
  }
  return 2.0 * largest;
}

}  // namespace trueaxis::form
