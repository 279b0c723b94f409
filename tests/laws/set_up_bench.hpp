// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "laws/law_case.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::laws {

/// A part of the virtual lathe that is clamped several times; plan.setups holds every set-up with
/// x0, y0, l, m of its own.
struct SetUpBench {
  virtual_lathe::Scenario scenario;

  bool is_cone() const { return scenario.part.kind == virtual_lathe::PartKind::cone; }
  std::size_t shape_count() const { return is_cone() ? 2 : 1; }
  std::size_t parameter_count() const { return 4 * scenario.plan.setups.size() + shape_count(); }

  /// What a fit should report: x0, y0 where the axis pierces Z = 0 (the lathe's origin of the part
  /// is at z_shift), l, m, then k from Z = 0 and the half angle, or the radius.
  std::vector<double> expected(const virtual_lathe::Chucking& chucking) const {
    const double l = *chucking.l, m = *chucking.m, n = std::sqrt(1.0 - l * l - m * m);
    const double shift = chucking.z_shift_mm;
    std::vector<double> out{*chucking.x0_mm - shift * l / n, *chucking.y0_mm - shift * m / n, l, m};
    if (is_cone()) {
      out.push_back(*scenario.part.apex_mm + shift / n);
      out.push_back(scenario.part.half_angle_rad);
    } else {
      out.push_back(scenario.part.radius_mm);
    }
    return out;
  }
  /// Moves one parameter: x0, y0, l, m of each set-up, then apex and half angle, or the radius.
  void nudge(std::size_t parameter, double by) {
    std::vector<virtual_lathe::Chucking>& setups = scenario.plan.setups;
    if (parameter < 4 * setups.size()) {
      virtual_lathe::Chucking& of = setups[parameter / 4];
      std::optional<double>* own[] = {&of.x0_mm, &of.y0_mm, &of.l, &of.m};
      **own[parameter % 4] += by;
    } else if (!is_cone()) {
      scenario.part.radius_mm += by;
    } else if (parameter == 4 * setups.size()) {
      *scenario.part.apex_mm += by;
    } else {
      scenario.part.half_angle_rad += by;
    }
  }

  /// A helix over the part's length [low, high] in a new set-up.
  void add(virtual_lathe::Chucking chucking, double low_mm, double high_mm, double revolutions) {
    virtual_lathe::PlannedPass pass;
    chucking.number = pass.setup = static_cast<int>(scenario.plan.setups.size()) + 1;
    pass.start_mm = low_mm + chucking.z_shift_mm, pass.end_mm = high_mm + chucking.z_shift_mm;
    pass.feed_mm_per_rev = (high_mm - low_mm) / revolutions;
    pass.readings_per_revolution = 11.3;
    scenario.plan.passes.push_back(pass);
    scenario.plan.setups.push_back(chucking);
  }
};

inline virtual_lathe::Part bench_part(std::string_view surface, double radius_mm,
                                      double half_angle_rad, double middle_mm) {
  virtual_lathe::Part part;
  if (surface == "cone") {
    part.kind = virtual_lathe::PartKind::cone;
    part.half_angle_rad = half_angle_rad;
    part.apex_mm = middle_mm + radius_mm / std::tan(half_angle_rad);
  } else {
    part.kind = virtual_lathe::PartKind::cylinder;
    part.radius_mm = radius_mm;
  }
  return part;
}

/// Two set-ups: as clamped, and re-indexed by 70°, shifted by 12 mm, probed from behind, jogged,
/// clamped softer, with another axis.
inline SetUpBench fixed_bench(std::string_view surface) {
  SetUpBench bench;
  bench.scenario.part = bench_part(surface, 15.0, 10.0 * rad_per_deg, 40.0);
  virtual_lathe::Chucking first, second;
  first.x0_mm = 0.3, first.y0_mm = -0.2, first.l = 0.001, first.m = -0.003;
  second.x0_mm = -0.15, second.y0_mm = 0.4, second.l = -0.004, second.m = 0.002;
  second.reindex_rad = 70.0 * rad_per_deg, second.z_shift_mm = 12.0, second.rear = true;
  second.x_jog_mm = 0.1, second.clamp_force_ratio = 0.6;
  bench.add(first, 30.0, 50.0, 30.0);
  bench.add(second, 36.0, 56.0, 30.0);
  return bench;
}

/// Two or three set-ups, every later one moved, or from the other side in the same clamping.
inline SetUpBench draw_bench(std::string_view surface, Draw& draw, int set_ups) {
  SetUpBench bench;
  const double radius = draw.uniform(10.0, 30.0), length = draw.uniform(10.0, 30.0);
  const double middle = draw.uniform(-100.0, 100.0);
  bench.scenario.part = bench_part(surface, radius, draw.uniform(0.5, 20.0) * rad_per_deg, middle);
  const auto clamp = [&](virtual_lathe::Chucking& chucking) {
    chucking.l = draw.uniform(-0.02, 0.02), chucking.m = draw.uniform(-0.02, 0.02);
    chucking.x0_mm = draw.uniform(-1.0, 1.0) - *chucking.l * middle;
    chucking.y0_mm = draw.uniform(-1.0, 1.0) - *chucking.m * middle;
  };
  virtual_lathe::Chucking chucking;
  clamp(chucking);
  for (int i = 0; i < set_ups; ++i) {
    chucking.rear = draw.chance(0.5);
    chucking.x_jog_mm = i == 0 ? 0.0 : draw.uniform(-0.2, 0.2);
    if (i == 1 || (i > 1 && draw.chance(0.5))) {
      clamp(chucking);
      chucking.reindex_rad = draw.uniform(-3.0, 3.0);
      if (draw.chance(0.5)) chucking.z_shift_mm = draw.uniform(-15.0, 15.0);
      if (draw.chance(0.5)) chucking.clamp_force_ratio = draw.uniform(0.3, 1.5);
    }
    const double low = middle - draw.uniform(0.3, 0.5) * length;
    bench.add(chucking, low, low + draw.uniform(0.5, 1.0) * length, draw.uniform(10.0, 40.0));
  }
  return bench;
}

}  // namespace trueaxis::laws
