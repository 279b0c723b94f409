// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "diagnose/geometry/observation_mask.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

/// The same pass so many times, the probe back at its start between two.
LinearisationPoint passes_one_way(std::size_t readings, int passes) {
  const ProbeStream one = testing::arguments({.readings = readings});
  ProbeStream all = one;
  for (int pass = 2; pass <= passes; ++pass) {
    for (std::size_t i = 0; i < readings; ++i) {
      all.c_rad.push_back(one.c_rad[i]);
      all.position_mm.push_back(one.position_mm[i]);
      all.time_s.push_back(one.time_s[i] + pass * 200.0);
      all.pass.push_back(pass);
      all.reading_mm.push_back(0.0);
    }
  }
  return linearise_at(std::move(all), {testing::bench_clamping(0.1)}, testing::bench_base(0.1),
                      false);
}

// However little Z moves from one reading to the next, a helix is not a section: its blocks are of
// whole revolutions, and none is a whole pass.
TEST(ObservationMask, ADenseHelixIsNoSection) {
  for (const std::size_t readings : {500, 3000, 20000}) {
    const LinearisationPoint point = passes_one_way(readings, 3);
    const ObservationMask mask = make_observation_mask(point);
    EXPECT_NE(mask.block, "a section") << readings;
    EXPECT_GT(mask.folds(), 9u) << readings;
    EXPECT_FALSE(resolution_of(point, mask).sections) << readings;
  }
}

}  // namespace
}  // namespace trueaxis
