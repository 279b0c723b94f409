// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "study/sweep/block.hpp"
#include "study/sweep/summary.hpp"

namespace trueaxis::testing {

/// A part probed on one pass with 5 µm of noise that the stream does not state, so that u comes
/// from the residuals alone.
inline virtual_lathe::Scenario probed_part(virtual_lathe::PartKind kind) {
  using namespace virtual_lathe;
  Scenario scenario;
  Part& part = scenario.part;
  part.kind = kind;
  part.x0_mm = 0.08, part.y0_mm = -0.05, part.l = 4e-4, part.m = -7e-4;
  part.radius_mm = 30.0, part.d_mm = 1.5;
  if (kind == PartKind::cone) part.apex_mm = -150.0, part.half_angle_rad = 0.2;
  PlannedPass pass;
  pass.start_mm = 10.0, pass.end_mm = 40.0;
  pass.feed_mm_per_rev = 0.6, pass.readings_per_revolution = 8.3;
  scenario.plan.passes = {pass};
  scenario.noise.sigma_mm = 0.005;
  scenario.probe.states_noise = false;
  return scenario;
}

/// An axis of the grid over one number.
inline study::GridAxis over(const std::string& path, const std::vector<double>& values) {
  study::GridAxis axis{path, {}};
  for (const double value : values) axis.points.push_back({std::to_string(value), {{path, value}}});
  return axis;
}

inline study::Sweep sweep_of(const virtual_lathe::Scenario& base, std::vector<study::GridAxis> axes,
                             std::size_t repeats, std::uint64_t seed) {
  study::Sweep sweep;
  sweep.base = base;
  sweep.axes = std::move(axes);
  sweep.repeats = repeats;
  sweep.seed = seed;
  return sweep;
}

inline std::vector<study::BlockResult> run_all(const study::Sweep& sweep, int threads) {
  std::vector<study::BlockResult> results;
  study::run_blocks(sweep, study::blocks_of(sweep), threads,
                    [&](study::BlockResult&& result) { results.push_back(std::move(result)); });
  return results;
}

}  // namespace trueaxis::testing
