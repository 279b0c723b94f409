// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/covariance.hpp"

namespace trueaxis {

/// The reference surfaces of the catalogue, and `own`: a profile of the user's (RevolvedProfile).
enum class SurfaceKind {
  cone,      ///< x0, y0, l, m, k, half_angle
  cylinder,  ///< x0, y0, l, m, radius
  plane,     ///< a face: l, m, d
  section,   ///< one circle without Z: x0, y0, radius
  sphere,    ///< x0, y0, z0, radius
  torus,     ///< a groove or bead: x0, y0, l, m, z0, radius, minor_radius
  own,
};

/// The catalogue's id: "cone", "cylinder", "plane", "section", "sphere", "torus"; "own".
const char* to_string(SurfaceKind kind);

/// @throws InputError naming the ids of the catalogue
SurfaceKind surface_from_id(std::string_view id);

/// Whether a surface fixes a line along the spindle with a radius about it and is diagnosed and cut
/// to: cone, cylinder, plane and section. A sphere, a torus and a profile of one's own are fitted.
bool is_diagnosed(SurfaceKind kind);

/// A line nearly along the spindle: part frame, mm; passes (x, y, z_ref) with slopes dx/dz, dy/dz.
/// Direction cosines (Constantin et al. Eq. 1): l = slope_x n, m = slope_y n, n = 1/sqrt(1 +
/// slope²).
struct Axis {
  double x_mm = 0.0, y_mm = 0.0;        ///< where it pierces the plane z = z_ref
  double slope_x = 0.0, slope_y = 0.0;  ///< dx/dz and dy/dz, mm per mm
  double z_ref_mm = 0.0;

  std::array<double, 2> at(double z_mm) const {
    return {x_mm + slope_x * (z_mm - z_ref_mm), y_mm + slope_y * (z_mm - z_ref_mm)};
  }
};

struct AxisEstimate {
  Axis axis;
  AxisCovariance covariance{};

  /// Standard uncertainty of the axis point at z in its worse direction, mm: the square root of the
  /// largest eigenvalue of the 2 × 2 covariance of (x(z), y(z)) (Eq. 36).
  double u_at(double z_mm) const;
  /// Standard uncertainty of the slope in its worse direction, mm per mm; of both slopes together.
  double u_slope() const;
  double u_slopes() const;
  /// The size of the slope has this one, mm per mm: along it, or u_slope() if it is not larger.
  double u_tilt() const;
};

/// A right circular cone (or, with tan_half_angle = 0, a cylinder) about an axis. s runs along the
/// axis with s = 0 at (axis.x, axis.y, axis.z_ref); radius(s) = radius_mm + tan_half_angle · s.
struct Revolved {
  Axis axis;
  double radius_mm = 0.0;
  double tan_half_angle = 0.0;  ///< signed: positive where the radius grows with s
};

/// Where a line parallel to X meets a surface.
struct Intersection {
  double x_mm = 0.0;   ///< machine X, a radius
  double dx_dz = 0.0;  ///< along Z at fixed C, mm per mm
  double dx_dc = 0.0;  ///< along C at fixed Z, mm per rad
  bool hit = false;    ///< false: the line passes the surface by, only touches it, or meets
                       ///< the mirrored nappe only; the numbers are then NaN
};

enum class Root {
  front,
  rear
};  ///< front: the larger X, where a tool in front works; rear: the smaller

/// Exact intersection at spindle angle C and height Z of the line Y = height parallel to X. This is
/// the quadratic of theory.md, Eq. 7, with K = 1 + tan²(half angle), no tilt of the line. Eqs. 5–9.
Intersection intersect(const Revolved& surface, double c_rad, double z_mm, double height_mm = 0.0,
                       Root root = Root::front);

/// A surface of revolution of one's own: the radius over the height along an axis, with up to
/// `most` parameters. The function fit() associates it with a stream together with its axis. The
/// result has x0, y0, l, m and then the profile's parameters:
///
///     FitOptions options;
///     options.profile = std::make_shared<Barrel>();  // examples/own_surface.cpp
///     const FitResult result = fit(stream, options);
///
/// The radius must be smooth (Newton's method follows it along the probe line) and the readings
/// absolute contact points: no relative gauge and no ball. Diagnosis and correction know the
/// surfaces of the catalogue only.
class RevolvedProfile {
 public:
  static constexpr std::size_t most = 4;

  struct Parameter {
    std::string name;
    std::string unit;        ///< as the result prints it
    double start = 0.0;      ///< where the association starts
    double length_mm = 1.0;  ///< what one unit moves the surface by, roughly: for the conditioning
  };
  /// The radius and its derivatives.
  struct Radius {
    double mm = 0.0;
    double per_height = 0.0;  ///< mm per mm
    std::array<double, most> per_parameter{};
  };

  virtual ~RevolvedProfile() = default;
  virtual std::vector<Parameter> parameters() const = 0;
  /// At a height along the axis, mm from where the axis pierces the plane Z = 0.
  virtual Radius radius(double height_mm, std::span<const double> parameters) const = 0;
};

}  // namespace trueaxis
