// SPDX-License-Identifier: Apache-2.0
// A key that is none: what it may mean, as somebody meant it who wrote it.
#include "format/nearest_key.hpp"

#include <gtest/gtest.h>

namespace trueaxis::testing {
namespace {

struct Meant {
  std::string written;
  std::vector<std::string> known;
  std::string meant;
};

TEST(NearestKey, IsWhatWasMeant) {
  const std::vector<std::string> cut{"nose_radius_mm", "tool_height_mm", "tool_height_um",
                                     "speed_rpm", "feed_mm_per_rev"};
  const std::vector<std::string> sweep{"noise.sigma_mm", "noise.sigma_um", "noise.rho",
                                       "pass.length_mm", "pass.speed_rpm"};
  const std::vector<std::string> target{
      "surface",    "radius_mm", "coaxiality_tolerance_mm", "coaxiality_tolerance_um",
      "z_start_mm", "z_end_mm"};
  const Meant cases[] = {
      // Without its unit: of several the first.
      {"noise.sigma", sweep, "noise.sigma_mm"},
      {"coaxiality_tolerance", target, "coaxiality_tolerance_mm"},
      {"feed", cut, "feed_mm_per_rev"},
      // Without what precedes it, in its unit.
      {"sigma_um", sweep, "noise.sigma_um"},
      {"length_mm", sweep, "pass.length_mm"},
      {"tolerance_um", target, "coaxiality_tolerance_um"},
      {"tolerance", target, "coaxiality_tolerance_mm"},
      {"height_um", cut, "tool_height_um"},
      {"rpm", cut, "speed_rpm"},
      // What it is called elsewhere or was before.
      {"kind", target, "surface"},
      {"length_mm", target, "z_end_mm"},
      {"sigma_um", {"ball_radius_mm", "noise_mm", "noise_um"}, "noise_um"},
      {"bandwidth_hz", {"stroke_mm", "natural_frequency_hz"}, "natural_frequency_hz"},
      {"bore", {"feature", "weight"}, "feature"},
      // Letters: nearer than any of these.
      {"speed_rmp", cut, "speed_rpm"},
      {"radius_nm", target, "radius_mm"},
      // Nothing is near.
      {"colour", cut, ""},
      {"mm", cut, ""},
  };
  for (const Meant& one : cases)
    EXPECT_EQ(nearest_key(one.written, one.known), one.meant) << one.written;
}

}  // namespace
}  // namespace trueaxis::testing
