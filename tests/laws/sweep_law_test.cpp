// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "study/bound/quantities.hpp"
#include "study/sweep/files/sweep_journal.hpp"
#include "study/sweep/scenario_parameters.hpp"
#include "support/sweep_examples.hpp"
#include "trueaxis/units.hpp"

/// What must hold of any sweep.
namespace trueaxis::study {
namespace {

using namespace virtual_lathe;
using testing::over;
using testing::probed_part;
using testing::run_all;
using testing::sweep_of;

constexpr std::uint64_t seed = 20261121;

TEST(Sweep, OrderOfWorkDoesNotShow) {
  Sweep sweep =
      sweep_of(probed_part(PartKind::cylinder), {over("noise.sigma_mm", {0.002, 0.01})}, 130, seed);
  sweep.methods = {Method::fit, Method::tukey};
  sweep.drawn = {{"part.x0_mm", "part.x0_mm", Drawn::Kind::uniform, -0.2, 0.2}};
  const std::vector<BlockResult> whole = run_all(sweep, 2);
  for (const BlockResult& result : whole) {
    BlockResult alone = Worker(sweep).run(result.block);
    alone.seconds = result.seconds;
    EXPECT_EQ(encode(alone), encode(result));
    const BlockResult back = decode(encode(result));
    EXPECT_EQ(encode(back), encode(result));
  }
}

TEST(Sweep, MethodsSeeTheSameReadingsAndRepeatsOthers) {
  Sweep sweep =
      sweep_of(probed_part(PartKind::cone), {over("noise.sigma_mm", {0.002, 0.01})}, 1000, seed);
  sweep.methods = {Method::fit, Method::huber};
  std::set<std::uint64_t> seeds;
  for (std::size_t cell = 0; cell < cell_count(sweep); ++cell) {
    for (std::size_t repeat = 0; repeat < sweep.repeats; ++repeat)
      seeds.insert(seed_of(sweep, cell, repeat));
  }
  EXPECT_EQ(seeds.size(), 2 * sweep.repeats);  // two grid points
  EXPECT_EQ(seed_of(sweep, 0, 7), seed_of(sweep, 1, 7));
  EXPECT_NE(seed_of(sweep, 0, 7), seed_of(sweep, 2, 7));
}

// Every number that a scenario has can be set and read back, and only the paths asked for move.
TEST(ScenarioParameters, AreSetOneByOne) {
  for (const PartKind kind : {PartKind::cone, PartKind::cylinder, PartKind::face}) {
    Scenario scenario = probed_part(kind);
    scenario.effects.push_back({"part.roundness", {{"order", 3}, {"amplitude_mm", 0.004}}});
    scenario.plan.passes.push_back(scenario.plan.passes.front());
    for (const ScenarioParameter& known : scenario_parameters(scenario)) {
      Scenario changed = scenario;
      const double value = std::isinf(known.low) || known.low < 0.0 ? 0.37 : known.low + 0.37;
      set_parameter(changed, known.path, value);
      EXPECT_NEAR(parameter(changed, known.path), value, 1e-12) << known.path;
    }
  }
  Scenario scenario = probed_part(PartKind::cone);
  scenario.plan.passes.front().end_mm = -5.0;  // towards −Z
  set_parameter(scenario, "pass.length_mm", 20.0);
  EXPECT_EQ(scenario.plan.passes.front().end_mm, -10.0);
}

// Truth by hand: a cone given by a radius has its apex where the radius would be 0.
TEST(Quantities, AreThoseOfThePart) {
  Scenario scenario = probed_part(PartKind::cone);
  scenario.part.apex_mm.reset();
  scenario.part.radius_mm = 30.0, scenario.part.radius_at_mm = 10.0;
  scenario.part.half_angle_rad = -0.1;  // falls with Z: the apex lies beyond
  const std::vector<double> truth = true_values(scenario, {10.0, 40.0}, SurfaceKind::cone);
  EXPECT_NEAR(truth[4], 10.0 + 30.0 / std::tan(0.1), 1e-9);
  EXPECT_NEAR(truth[5], 0.1 / rad_per_deg, 1e-12);
  const double n = std::sqrt(1.0 - 4e-4 * 4e-4 - 7e-4 * 7e-4);
  EXPECT_NEAR(truth[8], 0.08 + 40.0 * 4e-4 / n, 1e-12);
  EXPECT_NEAR(truth[9], -0.05 - 40.0 * 7e-4 / n, 1e-12);
}

}  // namespace
}  // namespace trueaxis::study
