// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/refit/behind_play.hpp"
#include "measure/passes.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis::testing {
namespace {

using namespace diagnose_detail;

constexpr double run_out_mm = 0.01, lobes_mm = 0.003, radius_mm = 40.0;
constexpr int lobes = 5;

double x_mm(double c) {
  return radius_mm + run_out_mm * std::cos(c) + lobes_mm * std::cos(lobes * c);
}

LinearisationPoint cylinder_that_runs_out(const ProbeStream& stream) {
  Clamping clamping;
  clamping.shape = {{run_out_mm, 0.0, 0.0, 0.0, 0.0}, radius_mm, 0.0};
  return linearise_at(stream, {clamping}, bench_base(0.0), false);
}

// The stop operator on a way of 20000 steps per revolution, begun a revolution earlier. Ways of 200
// steps miss where X turns back by half a step: ½ (E + n² a) (π/200)² = 0.0105 µm, and the square
// of the run-out over the diameter is 0.0013 µm.
TEST(BehindPlay, IsThePlayOperatorOnTheWayOfX) {
  constexpr double tolerance_mm = 1.2e-5;
  for (const double per_turn : {9.3, 36.5, 301.0}) {
    HelixPlan plan;
    plan.per_turn = per_turn;
    const ProbeStream stream = arguments(plan);
    const LinearisationPoint point = cylinder_that_runs_out(stream);
    const Hypothesis wave = of_effect("spindle.radial_synchronous", {.order = lobes});
    const double linear[] = {lobes_mm, 0.0};
    for (const double play_mm : {0.0005, 0.004, 0.012}) {
      const BehindPlay behind = behind_play(point, {&wave, 1}, linear, play_mm);
      ASSERT_EQ(behind.side.size(), stream.size());
      double held_mm = 0.0, at = 0.0;
      const auto go_to = [&](double c) {
        const double steps = std::ceil(std::abs(c - at) / (two_pi / 20000.0)), from = at;
        for (double k = 1.0; k <= steps; ++k) {
          at = from + k / steps * (c - from);
          const double x = x_mm(at);
          held_mm = std::clamp(held_mm, x - 0.5 * play_mm, x + 0.5 * play_mm);
        }
      };
      for (std::size_t i = 0; i < stream.size(); ++i) {
        if (i == 0 || stream.pass[i] != stream.pass[i - 1]) {
          at = stream.c_rad[i] - two_pi * (stream.c_rad[i + 1] > stream.c_rad[i] ? 1.0 : -1.0);
          held_mm = x_mm(at);
        }
        go_to(stream.c_rad[i]);
        ASSERT_NEAR(x_mm(behind.c_rad[i]) - 0.5 * play_mm * behind.side[i], held_mm, tolerance_mm)
            << per_turn << " per revolution, play " << play_mm << ", reading " << i;
      }
    }
  }
}

// A vibration was then what it was when X took the play up: at a constant speed time goes with C.
TEST(BehindPlay, IsOfTheTimeOfItsPlace) {
  const ProbeStream stream = arguments({});
  const BehindPlay behind = behind_play(cylinder_that_runs_out(stream), {}, {}, 0.004);
  std::size_t held = 0;
  for (const Pass& pass : find_passes(stream)) {
    const auto [c, t] = std::pair(stream.c_rad[pass.begin], stream.time_s[pass.begin]);
    const double speed = (stream.c_rad[pass.end - 1] - c) / (stream.time_s[pass.end - 1] - t);
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      if ((behind.c_rad[i] - c) * speed <= 0.0) continue;  // before the pass, all of one time
      EXPECT_NEAR(behind.time_s[i], t + (behind.c_rad[i] - c) / speed, 1e-9) << i;
      held += behind.c_rad[i] != stream.c_rad[i];
    }
  }
  EXPECT_GT(held, stream.size() / 10);
}

// Never taken up: X goes no farther than to and fro within the play.
TEST(BehindPlay, OfMoreThanXMovesReadsOneValue) {
  const ProbeStream stream = arguments({});
  const LinearisationPoint point = cylinder_that_runs_out(stream);
  const BehindPlay behind = behind_play(point, {}, {}, 0.05);
  ASSERT_EQ(behind.c_rad.size(), stream.size());
  for (const double side : behind.side) EXPECT_EQ(side, 0.0);
  for (const double c : behind.c_rad) EXPECT_EQ(c, behind.c_rad[0]);
}

}  // namespace
}  // namespace trueaxis::testing
