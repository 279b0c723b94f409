// SPDX-License-Identifier: Apache-2.0
// Law: on every instruction set and for every length of stream, each reading's prediction is the
// root, found here in long double from the distance to the axis alone.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laws/law_case.hpp"
#include "laws/targets.hpp"
#include "model/normal_matrix.hpp"

namespace trueaxis::laws {
namespace {

using Long = long double;

/// Distance from the axis minus the radius, at machine X.
Long gap(const Revolved& surface, Long x, Long c, Long z) {
  const Axis& a = surface.axis;
  const Long n = 1 / std::sqrt(1 + Long{a.slope_x} * a.slope_x + Long{a.slope_y} * a.slope_y);
  const Long l = a.slope_x * n, m = a.slope_y * n;
  const Long px = x * std::cos(c) - a.x_mm, py = x * std::sin(c) - a.y_mm;
  const Long pz = z - a.z_ref_mm, s = px * l + py * m + pz * n;
  const Long qx = px - s * l, qy = py - s * m, qz = pz - s * n;
  return std::sqrt(qx * qx + qy * qy + qz * qz) - (surface.radius_mm + surface.tan_half_angle * s);
}

/// The root next to `near`, by secants in long double.
Long root_next_to(const Revolved& surface, Long near, Long c, Long z) {
  Long x0 = near, x1 = near * (1 + 1e-9L), f0 = gap(surface, x0, c, z);
  for (int i = 0; i < 20; ++i) {
    const Long f1 = gap(surface, x1, c, z);
    if (f1 == f0 || f1 == 0) break;
    const Long x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1, f0 = f1, x1 = x2;
  }
  return x1;
}

/// What one fit sees: a stream, its working parameters, and the surface that the ball's centre runs
/// on.
struct Probed {
  LawCase c;
  ProbeStream stream;
  std::vector<double> working;
  std::unique_ptr<Surface> surface;
  Revolved path;
};

Probed probed_of(const LawCase& c) {
  Probed probed{
      c, probe(c), working_of(c), make_surface(surface_from_id(c.surface), frame_of(c)), {}};
  probed.path = probed.surface->shape(probed.working);
  const double t = probed.path.tan_half_angle, ball = c.bore ? -c.ball_mm : c.ball_mm;
  probed.path.radius_mm += ball * std::sqrt(1.0 + t * t);
  return probed;
}

// Four roundings each of the prediction's terms and of sin C, cos C.
double tolerance_of(const LawCase& c) {
  return 8.0 * std::numeric_limits<double>::epsilon() * rounding_size_mm(c);
}

class KernelLaw : public ::testing::TestWithParam<std::string> {};
class LateralKernelLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(LateralKernelLaw, PredictionIsTheRootInLongDouble) {
  constexpr std::uint64_t seed = 20271;
  Draw draw(seed);
  for (int i = 0; i < 60; ++i) {
    const Probed s =
        probed_of(draw_case(GetParam(), draw, {.tilt_rad = 0.1, .readings_max = 200.0}));
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ' ' << to_literal(s.c));
    for_every_target([&](const char* target) {
      const PreparedStream prepared(s.stream);
      std::vector<double> residual(s.stream.size());
      ASSERT_TRUE(residuals(*s.surface, s.working, prepared, residual));
      for (std::size_t k = 0; k < residual.size(); ++k) {
        const double z = s.stream.has_position() ? s.stream.position_mm[k] : 0.0;
        const Long exact = root_next_to(s.path, s.stream.reading_mm[k], s.stream.c_rad[k], z);
        const double error =
            static_cast<double>(s.stream.reading_mm[k] - Long{residual[k]} - exact);
        ASSERT_LE(std::abs(error), tolerance_of(s.c)) << target << " reading " << k;
      }
    });
  }
}

TEST_P(KernelLaw, EveryLengthOfStreamPredictsEveryRow) {
  LawCase c;
  c.surface = GetParam();
  c.half_angle_deg = GetParam() == "cone" ? 12.0 : 0.0;
  c.x_mm = 3.0, c.y_mm = -1.0;
  if (GetParam() != "section") c.slope_x = 0.01, c.slope_y = -0.02;
  if (GetParam() == "section") c.end_mm = c.start_mm;
  c.noise_mm = 0.01;
  for_every_target([&](const char* target) {
    for (const int n : {1, 7, 127, 128, 129, 255, 256, 257, 1000, 8191, 8193}) {
      c.readings_per_revolution = 9.7, c.revolutions = (n - 0.5) / 9.7;
      const Probed s = probed_of(c);
      ASSERT_EQ(s.stream.size(), static_cast<std::size_t>(n));
      const PreparedStream prepared(s.stream);
      std::vector<double> residual(s.stream.size());
      ASSERT_TRUE(residuals(*s.surface, s.working, prepared, residual));
      double sum = 0.0;
      for (std::size_t k = 0; k < residual.size(); ++k) {
        const double z = s.stream.has_position() ? s.stream.position_mm[k] : 0.0;
        const double x = z * std::cos(s.stream.c_rad[k]), y = z * std::sin(s.stream.c_rad[k]);
        const double prediction = GetParam() == "plane"
                                      ? s.working[0] + s.working[1] * x + s.working[2] * y
                                      : intersect(s.path, s.stream.c_rad[k], z).x_mm;
        ASSERT_NEAR(residual[k], s.stream.reading_mm[k] - prediction, tolerance_of(c))
            << target << ' ' << n << " readings, row " << k;
        sum += residual[k] * residual[k];
      }
      // The padded tail must not count: a sum of n squares, rounded n times at worst.
      const NormalMatrix normal = accumulate(*s.surface, s.working, prepared, {});
      EXPECT_NEAR(normal.sum_rho, sum, 1e-15 * n * sum) << target << ' ' << n;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Catalogue, KernelLaw, ::testing::ValuesIn(catalogue_ids()), name_of);
INSTANTIATE_TEST_SUITE_P(Lateral, LateralKernelLaw, ::testing::ValuesIn(lateral_ids()), name_of);

TEST(Kernel, ALineThatMissesIsNotAPrediction) {
  LawCase c;
  c.surface = "section", c.end_mm = c.start_mm;
  c.x_mm = 19.0;
  const Probed s = probed_of(c);
  const PreparedStream prepared(s.stream);
  for_every_target([&](const char* target) {
    const std::vector<double> outside{21.0, 0.0, 20.0};
    EXPECT_FALSE(accumulate(*s.surface, outside, prepared, {}).valid) << target;
    EXPECT_TRUE(accumulate(*s.surface, s.working, prepared, {}).valid) << target;
  });
}

}  // namespace
}  // namespace trueaxis::laws
