// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "laws/lathe_cases.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {

/// A face on the virtual lathe, tilted by 1 mrad: out at 60 rpm, back at 151 rpm and out again,
/// re-indexed. `across`: from beyond the axis. The part's axis is where the spindle's pierces the
/// face, as a diagnosis assumes.
struct FaceBench {
  std::string name;
  bool across = false;
  double ball_mm = 0.0;

  static constexpr double l = 8e-4, m = -6e-4, d_mm = 12.0, reindex_rad = 0.9;

  double start_mm() const { return across ? -face_end_mm : 8.0; }
  double middle_mm() const { return 0.5 * (start_mm() + face_end_mm); }
  double half_mm() const { return 0.5 * (face_end_mm - start_mm()); }
  std::vector<LatheCase> cases() const {
    return lathe_cases(StreamKind::face, middle_mm(), half_mm());
  }

  virtual_lathe::Scenario scenario(double sigma_mm = 0.0) const {
    using namespace virtual_lathe;
    Scenario scenario;
    Part& part = scenario.part;
    part.kind = PartKind::face;
    part.l = l, part.m = m, part.d_mm = d_mm;
    const double n2 = 1.0 - l * l - m * m;
    part.x0_mm = -l * d_mm / n2, part.y0_mm = -m * d_mm / n2;
    PlannedPass out;
    out.start_mm = start_mm(), out.end_mm = face_end_mm;
    out.feed_mm_per_rev = across ? 2.6 : 1.1;
    out.readings_per_revolution = 23.7;
    PlannedPass back = out;
    back.start_mm = face_end_mm, back.end_mm = start_mm(), back.speed_rpm = 151.0;
    PlannedPass again = out;
    again.setup = 2;
    scenario.plan.passes = {out, back, again};
    Chucking first, second;
    second.number = 2, second.reindex_rad = reindex_rad;
    scenario.plan.setups = {first, second};
    scenario.probe.ball_radius_mm = ball_mm;
    scenario.noise.sigma_mm = sigma_mm;
    return scenario;
  }

  /// The place of the face: its axis at the height where the ball's centre runs above it.
  diagnose_detail::Clamping clamping() const {
    const double n = std::sqrt(1.0 - l * l - m * m);
    diagnose_detail::Clamping clamping;
    clamping.shape.axis = {0.0, 0.0, l / n, m / n, (d_mm + ball_mm) / n};
    return clamping;
  }

  diagnose_detail::LinearisationPoint point(const ProbeStream& stream) const {
    diagnose_detail::BaseKind base;
    base.face = true;
    diagnose_detail::Clamping first = clamping(), second = first;
    second.number = 2, second.reindex_rad = reindex_rad, second.axis = 1;
    base.axes = 2;
    return linearise_at(stream, {first, second}, base, false);
  }
};

inline void PrintTo(const FaceBench& bench, std::ostream* out) { *out << bench.name; }

}  // namespace trueaxis::testing
