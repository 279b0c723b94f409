// SPDX-License-Identifier: Apache-2.0
// What is exact about a surface's own numbers: its start on readings without noise, its u, its
// derivatives.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "support/conical_profile.hpp"
#include "surface/own_surface.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// The root of the larger eigenvalue of the axis' covariance at Z, made by the matrix itself.
TEST(SurfaceAxis, ItsUIsThatOfTheWorstDirection) {
  Eigen::Matrix4d factor;
  factor << 3.0, 0.5, -0.2, 0.1, 0.7, 1.0, 0.4, 0.3, 0.05, 0.02, 0.06, 0.01, -0.03, 0.04, 0.02,
      0.08;
  const Eigen::Matrix4d covariance = factor * factor.transpose();
  AxisEstimate axis;
  axis.axis.z_ref_mm = 20.0;
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      axis.covariance.by_rows[static_cast<std::size_t>(4 * i + j)] = covariance(i, j);
  for (const double z_mm : {-100.0, 20.0, 35.0}) {
    Eigen::Matrix<double, 2, 4> at;
    at << Eigen::Matrix2d::Identity(), (z_mm - 20.0) * Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d of = at * covariance * at.transpose();
    const double u = std::sqrt(of.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
    EXPECT_NEAR(axis.u_at(z_mm), u, 1e-12 * u);
  }
  const Eigen::Matrix2d slopes = covariance.bottomRightCorner<2, 2>();
  EXPECT_NEAR(axis.u_slope(), std::sqrt(slopes.eigenvalues().real().maxCoeff()), 1e-12);
  EXPECT_NEAR(axis.u_slopes(), std::sqrt(slopes.trace()), 1e-12);
}

/// Readings of a cone along the spindle, 24 in a turn.
struct LevelReadings {
  std::vector<double> x, cos_c, sin_c, z;

  explicit LevelReadings(const Revolved& surface) {
    for (int i = 0; i < 240; ++i) {
      const double c = two_pi * i / 24.0;
      z.push_back(0.25 * i - 30.0 + surface.axis.z_ref_mm);
      x.push_back(intersect(surface, c, z.back()).x_mm);
      cos_c.push_back(std::cos(c)), sin_c.push_back(std::sin(c));
    }
  }
  ReadingBlock block() const { return {x.data(), cos_c.data(), sin_c.data(), z.data()}; }
};

// Without a tilt the equation of the start is exact. The rounding of squares of 40 mm over an
// eccentricity of 1 mm.
TEST(RevolvedStart, LevelIsExactForASurfaceAlongTheSpindle) {
  for (const double t : {0.0, 0.15, -0.3}) {
    const Revolved surface{{1.3, -0.7, 0.0, 0.0, 55.0}, 40.0, t};
    const LevelReadings readings(surface);
    SurfaceFrame frame;
    frame.position_ref_mm = 55.0, frame.half_length_mm = 30.0;
    const auto start =
        catalogue_entry(SurfaceKind::cone).make(frame)->level_start(readings.block(), 240);
    const double expected[] = {1.3, -0.7, 0.0, 0.0, 40.0, t};
    ASSERT_EQ(start.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(start[i], expected[i], 1e-10) << t << ' ' << i;
  }
}

// With a tilt it leaves out x² bx², which at 40 mm and 3 mrad is 1e-4 of (40 mm)² · 1e-5.
TEST(RevolvedStart, IsNearASurfaceThatLeans) {
  for (const double t : {0.0, 0.15, -0.3}) {
    const Revolved surface{{1.3, -0.7, 3e-3, -2e-3, 55.0}, 40.0, t};
    const LevelReadings readings(surface);
    SurfaceFrame frame;
    frame.position_ref_mm = 55.0, frame.half_length_mm = 30.0;
    const auto start = catalogue_entry(SurfaceKind::cone).make(frame)->start(readings.block(), 240);
    const double expected[] = {1.3, -0.7, 3e-3, -2e-3, 40.0, t};
    const double dropped = 40.0 * 13e-6;  // half of r (bx² + by²), and as much of the slopes' own
    ASSERT_EQ(start.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(start[i], expected[i], i < 2 || i == 4 ? dropped : dropped / 30.0)
          << t << ' ' << i;
  }
}

// Whatever order readings come in, their sums differ by the rounding of 240 terms, times the
// condition of the start's equations, which is below 100, and lengths of 40 mm.
TEST(RevolvedStart, IsOfAllReadingsInAnyOrder) {
  constexpr double rounding_mm = 240.0 * 2.2e-16 * 100.0 * 40.0;
  LevelReadings readings({{1.3, -0.7, 3e-3, -2e-3, 55.0}, 40.0, 0.15});
  for (std::size_t i = 0; i < 240; ++i) readings.x[i] += 0.1 * std::sin(double(i * i));
  LevelReadings reversed = readings;
  for (std::vector<double>* column : {&reversed.x, &reversed.cos_c, &reversed.sin_c, &reversed.z})
    std::ranges::reverse(*column);
  SurfaceFrame frame;
  frame.position_ref_mm = 55.0, frame.half_length_mm = 30.0;
  for (const SurfaceKind kind : {SurfaceKind::section, SurfaceKind::cylinder, SurfaceKind::cone}) {
    const auto surface = catalogue_entry(kind).make(frame);
    const auto start = surface->start(readings.block(), 240);
    const auto other = surface->start(reversed.block(), 240);
    for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(start[i], other[i], rounding_mm);
  }
}

// A gauge shows X and an offset. The mean of X is the nominal radius less the square of the
// eccentricity over four times the radius. The start is near to within a few times that.
TEST(RevolvedStart, OfAGaugeFindsItsOffset) {
  constexpr double radius_mm = 40.0, offset_mm = -39.2, near_mm = (1.3 * 1.3 + 0.7 * 0.7) / 40.0;
  for (const Root root : {Root::front, Root::rear}) {
    const double side = root == Root::front ? 1.0 : -1.0;
    LevelReadings readings({{1.3, -0.7, 0.0, 0.0, 55.0}, radius_mm, 0.0});
    for (std::size_t i = 0; i < 240; ++i) {  // from behind it is half a turn on
      readings.x[i] = side * (readings.x[i] + offset_mm);
      readings.cos_c[i] *= side, readings.sin_c[i] *= side;
    }
    SurfaceFrame frame;
    frame.position_ref_mm = 55.0, frame.half_length_mm = 30.0, frame.root = root;
    frame.indication = Indication::relative, frame.nominal_radius_mm = radius_mm;
    const double expected[] = {1.3, -0.7, 0.0, 0.0, side * offset_mm};
    const auto cylinder = catalogue_entry(SurfaceKind::cylinder).make(frame);
    for (const auto& start :
         {cylinder->start(readings.block(), 240), cylinder->level_start(readings.block(), 240)}) {
      ASSERT_EQ(start.size(), 5U);
      for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(start[i], expected[i], near_mm) << i;
    }
  }
}

// A cone that nearly ends within the length is blunted to 0.9 of the radius over half of it. The
// axis is pulled in to 0.8 of the least radius.
TEST(RevolvedStart, LevelLeavesRoomAroundTheSpindle) {
  constexpr double half_mm = 30.0, radius_mm = 40.0;
  SurfaceFrame frame;
  frame.position_ref_mm = 55.0, frame.half_length_mm = half_mm;
  const auto cone = catalogue_entry(SurfaceKind::cone).make(frame);
  const struct {
    double x, y, steep, pulled, blunted;
  } cases[] = {{0.5, -0.3, 0.95, 1.0, 0.9},
               {-0.5, 0.3, -0.95, 1.0, -0.9},
               {28.0, -21.0, 0.0, 0.8 * 40.0 / 35.0, 0.0},
               {4.0, -3.0, 0.85, 0.8 * 6.0 / 5.0, 0.85}};
  for (const auto& c : cases) {
    const double per_mm = radius_mm / half_mm;
    const LevelReadings readings({{c.x, c.y, 0.0, 0.0, 55.0}, radius_mm, c.steep * per_mm});
    const auto start = cone->level_start(readings.block(), 240);
    const double expected[] = {c.pulled * c.x, c.pulled * c.y,    0.0, 0.0,
                               radius_mm,      c.blunted * per_mm};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(start[i], expected[i], 1e-9) << i;
  }
}

// Its bend, (1 + t²) R times the slope, is then more than a tenth of half the length.
TEST(RevolvedStart, ATiltMayBeMirroredOnAShortPart) {
  SurfaceFrame frame;
  frame.half_length_mm = 10.0;
  const auto cylinder = catalogue_entry(SurfaceKind::cylinder).make(frame);
  const auto cone = catalogue_entry(SurfaceKind::cone).make(frame);
  for (const double share : {0.98, 1.02}) {
    const double slope = share * 0.1 * 10.0 / 25.0;
    const std::vector<double> of_cylinder{9.0, 9.0, 0.6 * slope, -0.8 * slope, 25.0};
    const std::vector<double> of_cone{9.0, 9.0, -0.3 * slope, 0.4 * slope, 25.0, -1.0};
    EXPECT_EQ(cylinder->tilt_may_be_mirrored(of_cylinder), share > 1.0);
    EXPECT_EQ(cone->tilt_may_be_mirrored(of_cone), share > 1.0);
  }
  const auto section = catalogue_entry(SurfaceKind::section).make(frame);
  EXPECT_FALSE(section->tilt_may_be_mirrored(std::vector{9.0, 9.0, 25.0}));
}

// What is reported, Eqs. 24 and 25, by differences of its own formulas: where the axis crosses
// Z = 0, its direction, the apex and the half angle.
TEST(SurfaceCatalogue, ReportedJacobianIsThatOfTheReportedNumbers) {
  const auto reported = [](const std::array<double, 6>& at,
                           double z_mm) {  // x, y, slopes, R, t at z
    const double n = 1.0 / std::hypot(1.0, at[2], at[3]);
    return std::array<double, 6>{
        at[0] - at[2] * z_mm,       at[1] - at[3] * z_mm, at[2] * n, at[3] * n,
        (z_mm / n) - at[4] / at[5], -std::atan(at[5])};
  };
  Revolved cone{{1.3, -0.7, 0.3, -0.2, 55.0}, 40.0, -0.3};
  const double z = 70.0, s = 15.0 * std::hypot(1.0, 0.3, 0.2);
  const std::array<double, 6> at{
      1.3 + 0.3 * 15.0, -0.7 - 0.2 * 15.0, 0.3, -0.2, 40.0 - 0.3 * s, -0.3};
  const std::vector<double> jacobian = reported_jacobian(SurfaceKind::cone, cone, z);
  ASSERT_EQ(jacobian.size(), 36U);
  for (std::size_t j = 0; j < 6; ++j) {
    std::array<double, 6> up = at, down = at;
    constexpr double h = 1e-5;
    up[j] += h, down[j] -= h;
    const auto a = reported(up, z), b = reported(down, z);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(jacobian[6 * i + j], (a[i] - b[i]) / (2.0 * h), 1e-6 * (1.0 + std::abs(a[i])))
          << i << ' ' << j;
  }
}

// For a face: l, m and d of the plane at right angles to the axis through its point at z_ref,
// Eq. 11.
TEST(SurfaceCatalogue, ReportedJacobianOfAFaceIsThatOfItsPlane) {
  const auto reported = [](const std::array<double, 3>& at) {  // slopes, z_ref
    const double n = 1.0 / std::hypot(1.0, at[0], at[1]);
    return std::array<double, 3>{at[0] * n, at[1] * n, at[2] * n};
  };
  const std::array<double, 3> at{0.3, -0.2, 55.0};
  const Revolved face{{0.0, 0.0, at[0], at[1], at[2]}, 0.0, 0.0};
  const std::vector<double> jacobian = reported_jacobian(SurfaceKind::plane, face, 30.0);
  ASSERT_EQ(jacobian.size(), 18U);
  for (std::size_t j = 0; j < 3; ++j) {
    std::array<double, 3> up = at, down = at;
    constexpr double h = 1e-5;
    up[j] += h, down[j] -= h;
    const auto a = reported(up), b = reported(down);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(jacobian[6 * i + 2 + j], (a[i] - b[i]) / (2.0 * h), 1e-6 * (1.0 + std::abs(a[i])))
          << i << ' ' << j;
  }
}

/// d prediction / d working of a block by differences, against the columns; h⁴ and rounding over h.
void expect_derivatives(const Surface& surface, const std::vector<double>& working,
                        const LevelReadings& at) {
  const auto p = surface.parameter_count();
  std::vector<double> transform(p * surface.column_count());
  surface.transform(working, transform.data());
  PredictionBlock block, moved;
  surface.evaluate(working, at.block(), block);
  ASSERT_TRUE(block.valid);
  for (std::size_t a = 0; a < p; ++a) {
    const double h = 1e-3 / surface.working_scale_mm(working)[a];
    std::array<double, block_size> slope{};
    for (const auto& [steps, weight] :
         {std::pair(1.0, 8.0), {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
      std::vector<double> there = working;
      there[a] += steps * h;
      surface.evaluate(there, at.block(), moved);
      for (std::size_t i = 0; i < block_size; ++i)
        slope[i] -= weight * moved.residual[i] / (12.0 * h);
    }
    for (std::size_t i = 0; i < block_size; ++i) {
      double column = 0.0;
      for (std::size_t j = 0; j < surface.column_count(); ++j)
        column += transform[a * surface.column_count() + j] * block.column[j][i];
      ASSERT_NEAR(column, slope[i], 1e-9 / (h * 1e3) + 1e-9) << a << ' ' << i;
    }
  }
}

TEST(OwnSurfaceProfile, ItsDerivativesAreThoseOfItsPrediction) {
  for (const Root root : {Root::front, Root::rear}) {
    SurfaceFrame frame;
    frame.position_ref_mm = 55.0, frame.half_length_mm = 30.0, frame.root = root;
    Revolved about{{1.3, -0.7, 0.08, -0.05, 55.0}, 40.0, 0.2};
    LevelReadings readings(about);
    if (root == Root::rear)
      for (double& x : readings.x) x = -x;
    expect_derivatives(*own_entry(std::make_shared<testing::ConicalProfile>()).make(frame),
                       {1.3, -0.7, 0.08, -0.05, 29.0, 0.2}, readings);
  }
}

// A profile of one's own that is a cone has the numbers of the catalogue's, on both sides.
TEST(OwnSurfaceProfile, AConeHasTheNumbersOfACone) {
  for (const Root root : {Root::front, Root::rear}) {
    SurfaceFrame frame;
    frame.position_ref_mm = 55.0, frame.half_length_mm = 30.0, frame.root = root;
    const double secant = std::hypot(1.0, 0.08, 0.05);
    const std::vector<double> of_own{1.3, -0.7, 0.08, -0.05, 29.0, 0.2};
    const std::vector<double> of_cone{1.3, -0.7, 0.08, -0.05, 29.0 + 0.2 * 55.0 * secant, 0.2};
    const auto own = own_entry(std::make_shared<testing::ConicalProfile>()).make(frame);
    const auto cone = catalogue_entry(SurfaceKind::cone).make(frame);
    EXPECT_NEAR(own->shape(of_own).radius_mm, of_cone[4], 1e-12);
    EXPECT_NEAR(own->shape(of_own).tan_half_angle, 0.2, 1e-15);
    EXPECT_EQ(own->axis_jacobian(of_own), cone->axis_jacobian(of_cone));
    const Surface::Reported a = own->report(of_own), b = cone->report(of_cone);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(a.value[i], b.value[i], 1e-12) << i;
      for (std::size_t j = 0; j < 6; ++j)
        EXPECT_NEAR(a.jacobian[6 * i + j], b.jacobian[6 * i + j], 1e-12) << i << ' ' << j;
    }
    for (std::size_t i = 4; i < 6; ++i) {  // its own parameters are reported as they are
      EXPECT_EQ(a.value[i], of_own[i]);
      for (std::size_t j = 0; j < 6; ++j) EXPECT_EQ(a.jacobian[6 * i + j], i == j ? 1.0 : 0.0);
    }
    for (double c = 0.0; c < 6.0; c += 0.7) {
      const auto found = own->influences(of_own, c, 40.0 + c);
      const auto expected = cone->influences(of_cone, c, 40.0 + c);
      EXPECT_NEAR(found.height, expected.height, 1e-11);
      EXPECT_NEAR(found.c, expected.c, 1e-10);
      EXPECT_NEAR(found.position, expected.position, 1e-11);
    }
  }
}

// Z = 12 + 2e-3 x − 3e-3 y: its axis is its normal through the spindle's axis, where it meets it.
TEST(SurfacePlane, ItsShapeIsItsAxis) {
  const auto plane = catalogue_entry(SurfaceKind::plane).make({});
  const std::vector<double> working{12.0, 2e-3, -3e-3};
  const Revolved shape = plane->shape(working);
  EXPECT_EQ(shape.radius_mm, 0.0);
  EXPECT_EQ(shape.tan_half_angle, 0.0);
  EXPECT_EQ(shape.axis.at(12.0), (std::array{0.0, 0.0}));
  EXPECT_EQ(shape.axis.slope_x, -2e-3);
  EXPECT_EQ(shape.axis.slope_y, 3e-3);
}

// A shift of 1 mm, a slope over the radius, or over the farthest X of a face, a radius.
TEST(SurfaceCatalogue, AUnitOfAParameterIsItsLengthOnTheSurface) {
  SurfaceFrame frame;
  frame.position_ref_mm = -20.0, frame.half_length_mm = 10.0;
  const auto scale_of = [&](SurfaceKind kind, const std::vector<double>& working) {
    return catalogue_entry(kind).make(frame)->working_scale_mm(working);
  };
  using Values = std::vector<double>;
  EXPECT_EQ(scale_of(SurfaceKind::section, {0.1, 0.2, 25.0}), (Values{1, 1, 1}));
  EXPECT_EQ(scale_of(SurfaceKind::cylinder, {0.1, 0.2, 0, 0, 25.0}), (Values{1, 1, 25, 25, 1}));
  EXPECT_EQ(scale_of(SurfaceKind::cone, {0.1, 0.2, 0, 0, 25.0, 0.3}),
            (Values{1, 1, 25, 25, 1, 25}));
  EXPECT_EQ(scale_of(SurfaceKind::plane, {12.0, 1e-3, 2e-3}), (Values{1, 30, 30}));
  EXPECT_EQ(scale_of(SurfaceKind::sphere, {0.1, 0.2, -21.0, 25.0}), (Values{1, 1, 1, 1}));
}

// A sphere of 25 mm whose centre is at (1.3, −0.7, 55), by its own closed form. The start is exact.
TEST(SurfaceSphere, ItsNumbersAreThoseOfTheSphere) {
  for (const Root root : {Root::front, Root::rear}) {
    SurfaceFrame frame;
    frame.position_ref_mm = 52.0, frame.half_length_mm = 15.0, frame.root = root;
    const std::vector<double> working{1.3, -0.7, 55.0, 25.0};
    LevelReadings at({{0.0, 0.0, 0.0, 0.0, 55.0}, 25.0, 0.0});
    for (std::size_t i = 0; i < at.x.size(); ++i) {
      at.z[i] = 55.0 + 0.5 * (at.z[i] - 55.0);
      const double along = 1.3 * at.cos_c[i] - 0.7 * at.sin_c[i];
      const double across = -0.7 * at.cos_c[i] - 1.3 * at.sin_c[i];
      const double deep = std::sqrt(25.0 * 25.0 - across * across - std::pow(at.z[i] - 55.0, 2));
      at.x[i] = along + (root == Root::front ? deep : -deep);
    }
    const auto sphere = catalogue_entry(SurfaceKind::sphere).make(frame);
    const std::vector<double> start = sphere->start(at.block(), 240);
    ASSERT_EQ(start.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(start[i], working[i], 1e-10) << i;
    expect_derivatives(*sphere, working, at);
    // Its axis is the spindle's direction through its centre.
    const std::vector<double> expected{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(sphere->axis_jacobian(working), expected);
  }
}

}  // namespace
}  // namespace trueaxis
