// SPDX-License-Identifier: Apache-2.0
#include "axis/sparse_case.hpp"

#include <algorithm>
#include <cmath>

#include "axis/draw.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::axis {
namespace {

using virtual_lathe::Effect;
using virtual_lathe::Scenario;

constexpr double twice_sigma = 2.0, largest_lobe_mm = 0.1, largest_local_mm = 0.2;

void draw_part(Draw& draw, SparseCase& out) {
  const bool cone = draw.unit() < 0.4;
  const double radius = draw.log_between(10.0, 100.0);
  const double length = draw.between(0.5, 2.5) * radius;
  const double e = std::min(draw.log_between(0.005, 0.3), 0.03 * radius), at = draw.phase();
  const double tilt = draw.log_between(5e-5, 2e-3), towards = draw.phase();
  Scenario& s = out.scenario;
  out.surface = cone ? "cone" : "cylinder";
  s.part.kind = cone ? virtual_lathe::PartKind::cone : virtual_lathe::PartKind::cylinder;
  s.part.half_angle_rad = cone ? draw.between(2.0, 20.0) * rad_per_deg : 0.0;
  s.part.radius_mm = radius;
  s.part.x0_mm = e * std::cos(at), s.part.y0_mm = e * std::sin(at);
  s.part.l = tilt * std::cos(towards), s.part.m = tilt * std::sin(towards);
  constexpr int angles[] = {8, 12, 16, 24, 36};
  out.angles = angles[draw.whole(0, 4)], out.sections = draw.whole(3, 6);
  out.low_mm = 0.0, out.high_mm = length;
  s.u_start_mm = 0.0, s.u_end_mm = length;
  for (int k = 0; k < out.sections; ++k) {
    virtual_lathe::PlannedPass section;
    section.start_mm = section.end_mm = length * k / (out.sections - 1);
    section.readings_per_revolution = out.angles;
    section.revolutions = (out.angles - 1.0) / out.angles;
    section.c_start_rad = two_pi * k;
    s.plan.passes.push_back(section);
  }
  s.noise.sigma_mm = draw.log_between(1e-3, 5e-3);
  s.probe.states_noise = false;
  s.seed = draw.random();
}

void draw_lobes(Draw& draw, SparseCase& out) {
  const int count = draw.whole(1, 3);
  std::vector<int> taken;
  while (static_cast<int>(taken.size()) < count) {
    const int order = draw.whole(2, 6);
    if (std::ranges::find(taken, order) != taken.end()) continue;
    taken.push_back(order);
    const double a = draw.log_between(twice_sigma * out.scenario.noise.sigma_mm, largest_lobe_mm);
    const double growth = draw.unit() < 0.5 ? 0.0 : draw.between(-1.0, 1.0) * a;
    out.scenario.effects.push_back({"part.roundness",
                                    {{"order", order},
                                     {"amplitude_mm", a},
                                     {"growth_mm", growth},
                                     {"phase_rad", draw.phase()}}});
  }
}

void draw_local(Draw& draw, SparseCase& out) {
  const double depth =
      draw.log_between(twice_sigma * out.scenario.noise.sigma_mm, largest_local_mm);
  const double at = draw.phase(), width = draw.log_between(0.05, 0.5);
  const double length = out.high_mm - out.low_mm;
  if (draw.unit() < 0.4) {
    out.scenario.effects.push_back(
        {"extra.bump", {{"amplitude_mm", -depth}, {"angle_rad", at}, {"width_rad", width}}});
    return;
  }
  out.scenario.effects.push_back({"extra.dent",
                                  {{"angle_rad", at},
                                   {"position_mm", draw.between(0.0, 1.0) * length},
                                   {"depth_mm", depth},
                                   {"width_rad", width},
                                   {"length_mm", draw.log_between(0.1, 1.0) * length}}});
}

}  // namespace

std::string_view name_of(Hidden hidden) {
  constexpr std::string_view names[] = {"none", "lobes", "local", "both"};
  return names[static_cast<std::size_t>(hidden)];
}

SparseCase draw_sparse(Hidden hidden, std::uint64_t seed) {
  Draw draw(seed * 4 + static_cast<std::uint64_t>(hidden));
  SparseCase out;
  out.hidden = hidden, out.seed = seed;
  draw_part(draw, out);
  if (hidden == Hidden::lobes || hidden == Hidden::both) draw_lobes(draw, out);
  if (hidden == Hidden::local || hidden == Hidden::both) draw_local(draw, out);
  return out;
}

ProbeStream probe(const SparseCase& of) {
  ProbeStream out = virtual_lathe::simulate(of.scenario);
  out.time_s.clear(), out.pass.clear(), out.setup.clear();
  return out;
}

Diagnosis diagnosed(const SparseCase& of) {
  DiagnoseOptions options;
  options.threads = 1;
  options.fit.surface = of.surface == "cylinder" ? SurfaceKind::cylinder : SurfaceKind::cone;
  return diagnose(probe(of), options);
}

}  // namespace trueaxis::axis
