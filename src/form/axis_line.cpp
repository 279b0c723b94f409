// SPDX-License-Identifier: Apache-2.0
#include "form/axis_line.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "form/exchange.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

constexpr int directions = 12;  // a section begins with; others follow where they are needed
constexpr int most_additions = 50;

/// Least t with Σ_k q_k φ_k(centre, φ) + t ≥ the centre's distance in every direction φ, about an
/// axis that may lean.
double smallest(std::span<const CentrePoint> centres) {
  const auto [z_low, z_high] =
      std::ranges::minmax(centres | std::views::transform(&CentrePoint::z_mm));
  const double middle = 0.5 * (z_low + z_high), half = std::max(0.5 * (z_high - z_low), 1e-9);
  constexpr Eigen::Index unknowns = 5;
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> y;
  const auto add = [&](const CentrePoint& centre, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), z = (centre.z_mm - middle) / half;
    Eigen::VectorXd row(unknowns);
    row << 1.0, c, s, z * c, z * s;
    rows.push_back(row);
    y.push_back(c * centre.x_mm + s * centre.y_mm);
  };
  for (const CentrePoint& centre : centres)
    for (int k = 0; k < directions; ++k) add(centre, two_pi * k / directions);
  double size = 0.0;
  for (int round = 0; round < most_additions; ++round) {
    Exchange::Rows all(static_cast<Eigen::Index>(rows.size()), unknowns);
    for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Eigen::Index>(i)) = rows[i];
    const Nearest nearest = Exchange(std::move(all), Criterion::minimum_circumscribed)(y);
    size = nearest.q[0];
    double largest = 0.0;
    for (const CentrePoint& centre : centres) {
      const double z = (centre.z_mm - middle) / half;
      const double x = centre.x_mm - nearest.q[1] - z * nearest.q[3];
      const double off_y = centre.y_mm - nearest.q[2] - z * nearest.q[4];
      largest = std::max(largest, std::hypot(x, off_y));
      if (std::hypot(x, off_y) > size * (1.0 + 1e-13)) add(centre, std::atan2(off_y, x));
    }
    if (largest <= size * (1.0 + 1e-12) + 1e-15) break;
  }
  return 2.0 * size;
}

}  // namespace

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

double smallest_cylinder_mm(std::span<const CentrePoint> centres) {
  return centres.size() < 3 ? 0.0 : smallest(centres);
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
