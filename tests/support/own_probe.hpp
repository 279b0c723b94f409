// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

/// A probe and a part that share no line with the program or its virtual lathe: the contact of the
/// probe's line with a leaning cone by Newton's method on the distance from its axis.
namespace trueaxis::testing::own_probe {

/// The axis at Z = 0 and its slopes; radius there and its growth along the axis.
struct Part {
  double x_mm = 0.06, y_mm = 0.03, slope_x = 2e-4, slope_y = -1e-4;
  double radius_mm = 25.0, taper = 0.0;
  /// Form along the normal, of the angle about the part's axis and the place along it.
  std::function<double(double theta_rad, double s_mm)> form{};
};

/// X of the contact at the spindle angle C and Z.
inline double contact_mm(const Part& part, double c_rad, double z_mm) {
  const double n = std::sqrt(1.0 + part.slope_x * part.slope_x + part.slope_y * part.slope_y);
  const double dx = part.slope_x / n, dy = part.slope_y / n, dz = 1.0 / n;
  const double ux = std::cos(c_rad), uy = std::sin(c_rad);
  const double secant = std::sqrt(1.0 + part.taper * part.taper);
  double x_mm = part.radius_mm;
  for (int step = 0; step < 40; ++step) {
    const double px = x_mm * ux - part.x_mm, py = x_mm * uy - part.y_mm;
    const double s = px * dx + py * dy + z_mm * dz;
    const double rx = px - s * dx, ry = py - s * dy, rz = z_mm - s * dz;
    const double r = std::sqrt(rx * rx + ry * ry + rz * rz);
    double wanted = part.radius_mm + part.taper * s;
    if (part.form) wanted += secant * part.form(std::atan2(ry, rx), s);
    const double along = ux * dx + uy * dy;
    const double slope = (rx * (ux - along * dx) + ry * (uy - along * dy) - rz * along * dz) / r;
    x_mm -= (r - wanted) / (slope - part.taper * along);
  }
  return x_mm;
}

struct Stream {
  std::vector<double> x_mm, c_deg, z_mm;
  std::string header = "X_M[mm],C[deg],Z[mm]";

  std::size_t size() const { return x_mm.size(); }
  std::string text() const {
    std::string out = "# x_convention: radius\n" + header + "\n";
    for (std::size_t i = 0; i < size(); ++i) {
      char line[96];
      std::snprintf(line, sizeof line, "%.6f,%.5f,%.6f\n", x_mm[i], c_deg[i], z_mm[i]);
      out += line;
    }
    return out;
  }
  Stream& add(const Stream& more) {
    x_mm.insert(x_mm.end(), more.x_mm.begin(), more.x_mm.end());
    c_deg.insert(c_deg.end(), more.c_deg.begin(), more.c_deg.end());
    z_mm.insert(z_mm.end(), more.z_mm.begin(), more.z_mm.end());
    return *this;
  }
};

/// 36.7 readings per revolution, 1 mm of Z each, with white noise.
inline Stream helix(const Part& part, double from_mm = 10.0, double to_mm = 50.0,
                    double sigma_um = 2.0, std::uint64_t seed = 1) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, 1e-3 * sigma_um);
  Stream out;
  const auto count = static_cast<int>(36.7 * (to_mm - from_mm));
  for (int i = 0; i <= count; ++i) {
    const double turns = i / 36.7, c = 2.0 * std::numbers::pi * turns, z = from_mm + turns;
    out.x_mm.push_back(contact_mm(part, c, z) + noise(engine));
    out.c_deg.push_back(360.0 * turns);
    out.z_mm.push_back(z);
  }
  return out;
}

}  // namespace trueaxis::testing::own_probe
