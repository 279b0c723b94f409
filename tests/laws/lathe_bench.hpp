// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"
#include "trueaxis/surface.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {

/// A tilted eccentric part on the virtual lathe: out at 60 rpm, back at 151 rpm, and out again
/// re-indexed, with less clamping force and the X slide jogged.
struct LatheBench {
  std::string name;
  double tangent = 0.0;
  bool bore = false, rear = false;

  static constexpr double x0_mm = 0.2, y0_mm = -0.1, l = 1e-3, m = -5e-4, radius_mm = 40.0;
  static constexpr double start_mm = -20.0, end_mm = 30.0;
  static constexpr double reindex_rad = 0.9, jog_mm = 0.1, clamp = 0.6;

  virtual_lathe::Scenario scenario() const {
    using namespace virtual_lathe;
    Scenario scenario;
    Part& part = scenario.part;
    part.kind = tangent == 0.0 ? PartKind::cylinder : PartKind::cone;
    part.half_angle_rad = std::atan(tangent);
    part.bore = bore;
    part.x0_mm = x0_mm, part.y0_mm = y0_mm, part.l = l, part.m = m, part.radius_mm = radius_mm;
    PlannedPass out;
    out.start_mm = start_mm, out.end_mm = end_mm, out.feed_mm_per_rev = 5.3;
    out.readings_per_revolution = 23.7;
    PlannedPass back = out;
    back.start_mm = end_mm, back.end_mm = start_mm, back.speed_rpm = 151.0;
    PlannedPass again = out;
    again.setup = 2;
    scenario.plan.passes = {out, back, again};
    Chucking first, second;
    first.rear = second.rear = rear;
    second.number = 2, second.reindex_rad = reindex_rad, second.x_jog_mm = jog_mm;
    second.clamp_force_ratio = clamp;
    scenario.plan.setups = {first, second};
    return scenario;
  }

  Revolved surface() const {
    const double n = std::sqrt(1.0 - l * l - m * m);
    return {{x0_mm, y0_mm, l / n, m / n, 0.0}, radius_mm, tangent};
  }
};

inline void PrintTo(const LatheBench& bench, std::ostream* out) { *out << bench.name; }

/// What the terms need of every reading, from the ideal intersection; owns the columns.
struct LatheColumns {
  std::vector<double> c, z, t, speed, velocity, x, sensed, dx_dc, dx_dz, d2x_dc2, theta, chuck, s,
      clamp;
  bool bore, rear;
  double tangent;

  LatheColumns(const LatheBench& bench, const ProbeStream& stream)
      : c(stream.c_rad),
        z(stream.position_mm),
        t(stream.time_s),
        bore(bench.bore),
        rear(bench.rear),
        tangent(bench.tangent) {
    const Revolved surface = bench.surface();
    const Root root = rear ? Root::rear : Root::front;
    for (std::size_t i = 0; i < stream.size(); ++i) {
      const bool back = stream.pass[i] == 2, second = stream.setup[i] == 2;
      const double rpm = back ? 151.0 : 60.0;
      speed.push_back(rpm / 60.0 * two_pi);
      velocity.push_back((back ? -5.3 : 5.3) * rpm / 60.0);
      const Intersection at = intersect(surface, c[i], z[i], 0.0, root);
      x.push_back(at.x_mm);
      sensed.push_back(at.x_mm - (second ? LatheBench::jog_mm : 0.0));
      dx_dc.push_back(at.dx_dc);
      dx_dz.push_back(at.dx_dz);
      constexpr double step = 1e-4;  // cube root of the rounding, times the size of the slopes
      d2x_dc2.push_back((intersect(surface, c[i] + step, z[i], 0.0, root).dx_dc -
                         intersect(surface, c[i] - step, z[i], 0.0, root).dx_dc) /
                        (2.0 * step));
      add_contact(at.x_mm * std::cos(c[i]), at.x_mm * std::sin(c[i]), z[i]);
      theta.push_back(chuck.back() + (second ? LatheBench::reindex_rad : 0.0));
      clamp.push_back(second ? LatheBench::clamp : 1.0);
    }
  }

  // Rodrigues' rotation about (m, −l, 0) takes the part's axis back to Z.
  void add_contact(double px, double py, double pz) {
    constexpr double l = LatheBench::l, m = LatheBench::m;
    const double qx = px - LatheBench::x0_mm, qy = py - LatheBench::y0_mm;
    const double sine = std::hypot(l, m), n = std::sqrt(1.0 - sine * sine);
    const double kx = m / sine, ky = -l / sine, along = (kx * qx + ky * qy) * (1.0 - n);
    chuck.push_back(
        std::atan2(qy * n - sine * kx * pz + ky * along, qx * n + sine * ky * pz + kx * along));
    s.push_back(l * qx + m * qy + n * pz);
  }

  TermContext context() const {
    TermContext at;
    at.c_rad = c, at.z_mm = z, at.time_s = t;
    at.speed_rad_per_s = speed, at.velocity_mm_per_s = velocity;
    at.x_mm = x, at.sensed_mm = sensed;
    at.dx_dc = dx_dc, at.dx_dz = dx_dz, at.d2x_dc2 = d2x_dc2;
    at.theta_rad = theta, at.theta_chuck_rad = chuck, at.s_mm = s, at.clamp_force_ratio = clamp;
    at.z_mid_mm = 0.5 * (LatheBench::start_mm + LatheBench::end_mm);
    at.z_half_mm = 0.5 * (LatheBench::end_mm - LatheBench::start_mm);
    at.tan_half_angle = tangent, at.bore = bore, at.rear = rear;
    return at;
  }
};

}  // namespace trueaxis::testing
