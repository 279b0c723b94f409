// SPDX-License-Identifier: Apache-2.0
// Where to tap a part: where the probe reads it highest, by half of its run-out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/files/fit_files.hpp"
#include "report/report.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double off_mm = 0.05, noise_mm = 1e-4;

/// A cylinder that is off towards the probe at C = `high_deg`: a front probe reads r + off cos(C −
/// high), one at the rear the same with its sign turned.
ProbeStream probed(double high_deg, double sign) {
  ProbeStream stream;
  stream.source = "shaft.csv";
  for (int i = 0; i < 400; ++i) {
    const double c_rad = 0.61 * i;
    stream.c_rad.push_back(c_rad);
    stream.position_mm.push_back(-0.1 * i);
    stream.reading_mm.push_back(sign * (25.0 + off_mm * std::cos(c_rad - high_deg * rad_per_deg) +
                                        noise_mm * std::sin(7.7 * i)));
  }
  return stream;
}

FitResult fitted(const ProbeStream& stream) {
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  return fit(stream, options);
}

// 2 off = 100 µm of run-out; the offset is known to some 0.01 µm, so the digits are those of 50 µm.
TEST(Tap, IsWhereTheProbeReadsHighest) {
  for (const double high_deg : {30.0, 200.0, 359.8})
    for (const double sign : {1.0, -1.0}) {
      const std::string text = tap_text(fitted(probed(high_deg, sign)));
      const std::string at =
          "high spot at C = " + std::to_string(std::lround(high_deg) % 360) + "°, run-out 100";
      EXPECT_EQ(text.find(at), 0u) << sign << ' ' << text;
      EXPECT_NE(text.find(" mm: tap there by 50"), std::string::npos) << text;
    }
}

TEST(Tap, IsSaidAlikeOnScreenAndPage) {
  const ProbeStream stream = probed(30.0, 1.0);
  const FitResult result = fitted(stream);
  const std::string text = tap_text(result);
  ASSERT_FALSE(text.empty());
  EXPECT_TRUE(fit_screen(result).find("\ntap    The cylinder runs out 100") != std::string::npos)
      << fit_screen(result);
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  EXPECT_NE(render_fit_report(stream, result, options)
                .find("\"tap\":[\"high spot at C = 30\\u00b0, run-out 100"),
            std::string::npos);
}

// A face that is 10 µm higher at X 40 on one side than in the middle runs out 20 µm. Beyond the
// axis the probe meets the high spot half a turn later.
TEST(Tap, OfAFaceIsAtItsOuterEnd) {
  for (const double sign : {1.0, -1.0}) {
    ProbeStream face;
    face.kind = StreamKind::face;
    face.source = "face.csv";
    for (int i = 0; i <= 400; ++i) {
      const double x_mm = sign * (10.0 + 0.075 * i), c_rad = 0.61 * i;
      face.c_rad.push_back(c_rad), face.position_mm.push_back(x_mm);
      face.reading_mm.push_back(5.0 + 0.01 * x_mm / 40.0 * std::cos(c_rad - 123.0 * rad_per_deg) +
                                noise_mm * std::sin(7.7 * i));
    }
    FitOptions options;
    options.surface = SurfaceKind::plane;
    const std::string text = tap_text(fit(face, options));
    EXPECT_TRUE(text.starts_with(sign > 0.0 ? "high spot at C = 123°, run-out 20 µm at X 40 mm"
                                            : "high spot at C = 303°, run-out 20 µm at X -40 mm"))
        << text;
  }
}

TEST(Tap, IsNotSaidOfWhatIsNotKnown) {
  FitResult result = fitted(probed(30.0, 1.0));
  result.status = FitStatus::rank_deficient;
  EXPECT_EQ(tap_text(result), "");
  EXPECT_EQ(axis_screen(result), "");
}

}  // namespace
}  // namespace trueaxis
