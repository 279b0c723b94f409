// SPDX-License-Identifier: Apache-2.0
// Harmonics of a profile along the cut, as an actuator is to follow them.
#include "correct/spectrum.hpp"

#include <gtest/gtest.h>

#include "correct/profile.hpp"

namespace trueaxis {
namespace {

// An axis 0.3 mm off and tilted by 8 µm/mm: what goes with the square of the eccentricity is curved
// along Z, and the slope is that of the value by central differences. Over 2 µm these err by the
// third derivative times 2e-7 mm², below 1e-9 here; 1e-16 mm of rounding over 2e-3 mm is nothing.
TEST(Spectrum, SlopeIsTheDerivativeOfTheValue) {
  ToolSetup tool;
  tool.feed_mm_per_rev = 0.5;
  const Spectrum spectrum(Profile(
      Axis{0.30, 0.0, 0.0, 8e-3, 0.0},
      {.kind = TargetKind::cylinder, .z_start_mm = 0, .z_end_mm = 40.0, .radius_mm = 8.0}, tool));
  ASSERT_GE(spectrum.orders().size(), 3u);  // mean, eccentricity and what goes with its square
  constexpr double step_mm = 1e-3;
  std::vector<SlowAmplitude> before, at, after;
  for (const double share : {0.1, 0.5, 0.9}) {
    const double z = spectrum.start_mm() + share * (spectrum.end_mm() - spectrum.start_mm());
    spectrum.at(z - step_mm, before);
    spectrum.at(z, at);
    spectrum.at(z + step_mm, after);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto slope = (after[i].value - before[i].value) / (2.0 * step_mm);
      EXPECT_LT(std::abs(at[i].slope - slope), 1e-9) << spectrum.orders()[i] << " at " << z;
    }
  }
}

}  // namespace
}  // namespace trueaxis
