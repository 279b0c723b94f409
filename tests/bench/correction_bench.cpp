// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "trueaxis/correction.hpp"

namespace trueaxis {
namespace {

/// A cylinder of R 40 mm and the given number of revolutions (360 rows each) about an axis that is
/// off by 0.1 mm and tilted by 1 mrad.
void correct_cylinder(benchmark::State& state) {
  const AxisEstimate axis{.axis = {.x_mm = 0.08, .y_mm = 0.06, .slope_x = 6e-4, .slope_y = 8e-4}};
  const ToolSetup tool{.nose_radius_mm = 0.4, .height_mm = 0.05};
  const TargetSurface target{
      .z_start_mm = 0.0,
      .z_end_mm = -tool.feed_mm_per_rev * static_cast<double>(state.range(0)),
      .radius_mm = 40.0};
  std::size_t rows = 0;
  for (auto _ : state) {
    const Correction correction = make_correction(axis, target, tool, Actuator{});
    rows += correction.rows.wanted_mm.size();
    benchmark::DoNotOptimize(correction.rows.command_mm.data());
  }
  // "items_per_second" reads as rows a second.
  state.SetItemsProcessed(static_cast<std::int64_t>(rows));
}

BENCHMARK(correct_cylinder)->Arg(10)->Arg(100)->Arg(500)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trueaxis
