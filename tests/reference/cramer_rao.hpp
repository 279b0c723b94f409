// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

/// The Cramér-Rao bound from first principles: readings are numerical roots of "distance from the
/// axis minus radius", derivatives are central differences, all in long double. Nothing is shared
/// with the engine, nor with the closed forms of the benchmark's peers.
namespace trueaxis::reference {

using Real = long double;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Point = Eigen::Matrix<Real, 3, 1>;

/// A surface by its signed distance-like function at a part-frame point (mm), zero on the surface.
/// Parameters in the edge's units and order (mm, cosines, degrees).
struct Implicit {
  Real (*value)(const Point& point, const RealVector& p);
  bool face = false;  ///< the unknown is Z at (C, X), else X at (C, Z)
};

struct FromAxis {
  Real radius, along;  ///< distance from the axis; position along it from (x0, y0, 0), mm
};

inline FromAxis from_axis(const Point& point, const RealVector& p) {
  const Point direction(p[2], p[3], std::sqrt(1 - p[2] * p[2] - p[3] * p[3]));
  const Point from = point - Point(p[0], p[1], 0);
  return {from.cross(direction).norm(), from.dot(direction)};
}

/// p: x0, y0, l, m, k (mm), half angle (deg).
inline Real cone_implicit(const Point& point, const RealVector& p) {
  const FromAxis at = from_axis(point, p);
  const Real half_angle = p[5] * std::numbers::pi_v<Real> / 180;
  return at.radius - std::abs(p[4] - at.along) * std::tan(half_angle);
}

/// p: x0, y0, l, m, radius (mm).
inline Real cylinder_implicit(const Point& point, const RealVector& p) {
  return from_axis(point, p).radius - p[4];
}

/// p: l, m, d (mm): n·p = d.
inline Real plane_implicit(const Point& point, const RealVector& p) {
  const Point normal(p[0], p[1], std::sqrt(1 - p[0] * p[0] - p[1] * p[1]));
  return normal.dot(point) - p[2];
}

/// Reading at (C, position) by TOMS 748 within 5 mm of `near_mm`. Part frame: x = X cos C, y = X
/// sin C.
inline Real reading(const Implicit& surface, const RealVector& p, Real c_rad, Real position_mm,
                    Real near_mm) {
  const auto value = [&](Real unknown) {
    const Real x = surface.face ? position_mm : unknown, z = surface.face ? unknown : position_mm;
    return surface.value({x * std::cos(c_rad), x * std::sin(c_rad), z}, p);
  };
  std::uintmax_t steps = 100;
  const boost::math::tools::eps_tolerance<Real> exact(std::numeric_limits<Real>::digits - 2);
  const auto bracket =
      boost::math::tools::toms748_solve(value, near_mm - 5, near_mm + 5, exact, steps);
  return (bracket.first + bracket.second) / 2;
}

/// Standard deviations of the parameters that no unbiased estimator can go below: the roots of the
/// diagonal of σ²(JᵀJ)⁻¹, for independent Gaussian noise σ. `step` is that of the central
/// differences; a test halves it.
inline RealVector cramer_rao_sd(const Implicit& surface, const RealVector& p,
                                const RealVector& step, const std::vector<double>& c_rad,
                                const std::vector<double>& position_mm,
                                const std::vector<double>& near_mm, Real sigma_mm) {
  const auto rows = static_cast<Eigen::Index>(c_rad.size());
  RealMatrix jacobian(rows, p.size());
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    for (Eigen::Index j = 0; j < p.size(); ++j) {
      const RealVector delta = step[j] * RealVector::Unit(p.size(), j);
      const Real up = reading(surface, p + delta, c_rad[i], position_mm[i], near_mm[i]);
      const Real down = reading(surface, p - delta, c_rad[i], position_mm[i], near_mm[i]);
      jacobian(row, j) = (up - down) / (2 * step[j]);
    }
  }
  const RealVector scale = jacobian.colwise().norm().cwiseInverse();
  const RealMatrix scaled = jacobian * scale.asDiagonal();
  const RealMatrix inverse = (scaled.transpose() * scaled).inverse();
  return sigma_mm * (inverse.diagonal().cwiseSqrt().cwiseProduct(scale));
}

}  // namespace trueaxis::reference
