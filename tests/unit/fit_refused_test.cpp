// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "fit/plausible.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Whether a fit to 2880 readings has an axis, the first `rows` of a keyway of 18° cut so deep.
bool axis_known(std::size_t rows, double depth_mm) {
  std::mt19937_64 random(45);
  std::normal_distribution<double> normal(0.0, 1e-3);
  ProbeStream stream;
  std::size_t cut = 0;
  for (std::size_t i = 0; i < 2880; ++i) {
    const double c = two_pi * static_cast<double>(i) / 72.3;
    const bool in_keyway = std::cos(c) > std::cos(two_pi / 40.0);
    stream.c_rad.push_back(c);
    stream.position_mm.push_back(0.01 * static_cast<double>(i));
    stream.reading_mm.push_back(20.0 + 0.1 * std::cos(c) + normal(random) -
                                (in_keyway && ++cut <= rows ? depth_mm : 0.0));
  }
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  FitResult result = fit(stream, options);
  withhold_if_drawn(stream, result);
  return result.axis_known();
}

// 144 readings draw the axis by 2/2880 of the sum of their 2 mm, 0.2 mm; one of 0.2 mm by 0.14 µm,
// less than the U of 0.4 µm that it leaves.
TEST(DrawnFit, HasNoAxisBesideAKeyway) {
  EXPECT_FALSE(axis_known(2880, 2.0));
  EXPECT_TRUE(axis_known(1, 0.2));
}

std::string refusal(const ProbeStream& stream, SurfaceKind surface) {
  FitOptions options;
  options.surface = surface;
  try {
    fit(stream, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FitStream, ThatIsOfAnotherKindIsRefusedWithWhatItIs) {
  ProbeStream lateral;
  for (int i = 0; i < 48; ++i) {
    lateral.c_rad.push_back(0.3 * i), lateral.position_mm.push_back(0.8 * i);
    lateral.reading_mm.push_back(20.0);
  }
  EXPECT_NE(refusal(lateral, SurfaceKind::plane).find("columns Z_M,C,X"), std::string::npos);
  ProbeStream face = lateral;
  face.kind = StreamKind::face;
  EXPECT_NE(refusal(face, SurfaceKind::cone).find("--surface plane"), std::string::npos);
  ProbeStream section = lateral;
  section.position_mm.clear();
  EXPECT_NE(refusal(section, SurfaceKind::cone).find("has no Z"), std::string::npos);
  face.position_mm.clear();
  EXPECT_NE(refusal(face, SurfaceKind::plane).find("has no X"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis
