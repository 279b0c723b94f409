// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

namespace trueaxis::virtual_lathe {

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double f, const Vec3& a) { return {f * a.x, f * a.y, f * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 unit(const Vec3& a) { return (1.0 / std::sqrt(dot(a, a))) * a; }

/// spindle_from_part: origin and the part's three axes in the spindle frame.
struct RigidFrame {
  Vec3 origin, ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};

  /// The smallest rotation that takes Z to (l, m, n).
  static RigidFrame about(const Vec3& origin, double l, double m) {
    const double n = std::sqrt(1.0 - l * l - m * m);
    const double w = 1.0 / (1.0 + n);
    return {
        origin, {1.0 - w * l * l, -w * l * m, -l}, {-w * l * m, 1.0 - w * m * m, -m}, {l, m, n}};
  }

  Vec3 turned(const Vec3& p) const { return {dot(p, ex), dot(p, ey), dot(p, ez)}; }
  Vec3 part_from_spindle(const Vec3& point) const { return turned(point - origin); }
};

/// Spindle angle with its sine and cosine.
struct SpindleAngle {
  explicit SpindleAngle(double c_rad) : cosine(std::cos(c_rad)), sine(std::sin(c_rad)) {}
  double cosine, sine;

  /// Point of the machine in the frame that turns with the spindle.
  Vec3 spindle_from_machine(const Vec3& p) const {
    return {p.x * cosine - p.y * sine, p.x * sine + p.y * cosine, p.z};
  }
};

/// The probe's line in the part's frame; q is the reading.
struct Line {
  Vec3 base, direction;
  Vec3 at(double q) const { return base + q * direction; }
};

}  // namespace trueaxis::virtual_lathe
