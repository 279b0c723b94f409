// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>

#include "diagnose/geometry/linearisation_point.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

/// Two clampings, each probed on the side it says: the second re-indexed, shifted, jogged and
/// moved.
struct Bench {
  double tangent;
  Root first_side, second_side;
  double height_mm;
  std::vector<Clamping> clampings{2};
  ProbeStream stream = testing::arguments({.readings = 101, .passes = 2});

  Bench(double t, Root first, Root second, double height)
      : tangent(t), first_side(first), second_side(second), height_mm(height) {
    clampings[0].shape = {{0.2, -0.1, 1e-3, -5e-4, 0.0}, 40.0, t};
    clampings[0].root = first;
    clampings[1].shape = {{-0.15, 0.4, -4e-3, 2e-3, 0.0}, 40.0 + 3.0 * t, t};
    clampings[1].root = second;
    clampings[1].number = 2, clampings[1].axis = 1;
    clampings[1].reindex_rad = 1.2, clampings[1].z_shift_mm = 12.0;
    clampings[1].x_jog_mm = 0.1, clampings[1].clamp_force_ratio = 0.6;
    stream.setup = stream.pass;
  }
  LinearisationPoint point() const {
    BaseKind base = testing::bench_base(tangent);
    base.axes = 2;
    return linearise_at(stream, clampings, base, false, 1, {}, height_mm);
  }
  const Clamping& of(std::size_t i) const {
    return clampings[static_cast<std::size_t>(stream.setup[i] - 1)];
  }
};

/// The same surface with its axis point at another height.
Revolved about(const Revolved& from, double z_mm) {
  Revolved to = from;
  const auto [x, y] = from.axis.at(z_mm);
  const double secant = std::sqrt(1.0 + from.axis.slope_x * from.axis.slope_x +
                                  from.axis.slope_y * from.axis.slope_y);
  to.radius_mm += from.tan_half_angle * (z_mm - from.axis.z_ref_mm) * secant;
  to.axis.x_mm = x, to.axis.y_mm = y, to.axis.z_ref_mm = z_mm;
  return to;
}

/// Parameter j of an axis' own (x, y, slopes), then radius and tangent about s_ref. Slopes turn the
/// part rigidly about the spindle's point at z_mid: its axis' point there then moves along Z.
Revolved nudged(const Revolved& shape, const Clamping& clamping, const LinearisationPoint& point,
                std::size_t j, double by) {
  Revolved out = about(shape, point.z_mid_mm);
  double* const own[] = {&out.axis.x_mm, &out.axis.y_mm, &out.axis.slope_x, &out.axis.slope_y,
                         &out.radius_mm};
  if (j < 5) {
    *own[j] += by;
    if (j == 2 || j == 3) {
      const double down = by * (j == 2 ? out.axis.x_mm : out.axis.y_mm);
      out.radius_mm += out.tan_half_angle * down;
      out.axis.x_mm += out.axis.slope_x * down;
      out.axis.y_mm += out.axis.slope_y * down;
    }
    return out;
  }
  const double secant =
      std::sqrt(1.0 + out.axis.slope_x * out.axis.slope_x + out.axis.slope_y * out.axis.slope_y);
  out.tan_half_angle += by;
  // s of the part is 0 at z_shift beyond the axis' point at z = 0.
  out.radius_mm += by * (point.z_mid_mm * secant - clamping.z_shift_mm - point.s_ref_mm);
  return out;
}

class SceneOf : public ::testing::TestWithParam<std::tuple<double, Root, Root, double>> {
 protected:
  Bench bench() const { return std::make_from_tuple<Bench>(GetParam()); }
};

// Central differences of the exact intersection with a step h err by h²/6 of the third derivative
// and by rounding, 1e-16 × 40 mm/h: below 1e-7 of the lever for the steps chosen. What is missing
// is the square of the tilt, 2e-5: slopes are tangents, s runs along the axis.
TEST_P(SceneOf, BaseColumnsAreDifferencesOfTheIntersection) {
  const Bench b = bench();
  const LinearisationPoint point = b.point();
  const Eigen::MatrixXd columns = testing::explicit_columns(point, {});
  const std::size_t shared = 8;
  ASSERT_EQ(static_cast<std::size_t>(columns.cols()), b.tangent == 0.0 ? 9u : 10u);
  for (std::size_t i = 0; i < point.size(); i += 7) {
    const Clamping& clamping = b.of(i);
    for (std::size_t j = 0; j < (b.tangent == 0.0 ? 5u : 6u); ++j) {
      const double h = j == 2 || j == 3 || j == 5 ? 1e-6 : 1e-4;
      const auto at = [&](double by) {
        return intersect(nudged(clamping.shape, clamping, point, j, by), point.c[i], point.z[i],
                         b.height_mm, clamping.root)
            .x_mm;
      };
      const double expected = (at(h) - at(-h)) / (2.0 * h);
      const std::size_t own = j < 4 ? 4 * clamping.axis + j : shared + j - 4;
      const double lever = j < 2 || j == 4 ? 1.0 : 42.0;
      EXPECT_NEAR(columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(own)), expected,
                  3e-5 * lever)
          << "reading " << i << ", parameter " << j;
    }
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_EQ(columns(static_cast<Eigen::Index>(i),
                        static_cast<Eigen::Index>(4 * (1 - clamping.axis) + j)),
                0.0);
  }
}

// The least rotation from the axis to the spindle takes the contact to the part's frame.
TEST_P(SceneOf, ContactsAreInThePartsFrame) {
  const Bench b = bench();
  const LinearisationPoint point = b.point();
  PointRoom room;
  const PointPart all = point.all(room);
  for (std::size_t i = 0; i < point.size(); i += 7) {
    const Clamping& clamping = b.of(i);
    const Axis& axis = clamping.shape.axis;
    const double x =
        intersect(clamping.shape, point.c[i], point.z[i], b.height_mm, clamping.root).x_mm;
    const Eigen::Vector3d along = Eigen::Vector3d(axis.slope_x, axis.slope_y, 1.0).normalized();
    const Eigen::Vector3d contact = Eigen::AngleAxisd(point.c[i], Eigen::Vector3d::UnitZ()) *
                                    Eigen::Vector3d(x, b.height_mm, point.z[i]);
    const Eigen::Vector3d own =
        Eigen::Quaterniond::FromTwoVectors(along, Eigen::Vector3d::UnitZ()) *
        (contact - Eigen::Vector3d(axis.x_mm, axis.y_mm, 0.0));
    const double theta = std::atan2(own.y(), own.x());
    EXPECT_NEAR(std::remainder(all.chuck[i] - theta, two_pi), 0.0, 1e-12);
    EXPECT_NEAR(std::remainder(all.theta[i] - theta - clamping.reindex_rad, two_pi), 0.0, 1e-12);
    EXPECT_NEAR(all.s[i], own.z() - clamping.z_shift_mm, 1e-11);
    EXPECT_NEAR(own.head<2>().norm(),
                clamping.shape.radius_mm + clamping.shape.tan_half_angle * own.z(), 1e-10);
    EXPECT_NEAR(all.sensed[i], x - clamping.x_jog_mm, 1e-12);
    EXPECT_EQ(all.clamp[i], clamping.clamp_force_ratio);
    EXPECT_EQ(all.rear[i] != 0, clamping.root == Root::rear);
    EXPECT_GT(all.rear[i] ? -x : x, 0.0);
  }
}

// 151 rpm back and 60 rpm out; a third of the stream's length in Z per 101 readings of 23.7 a turn.
TEST_P(SceneOf, MotionIsThatOfThePlan) {
  const Bench b = bench();
  const LinearisationPoint point = b.point();
  PointRoom room;
  const PointPart all = point.all(room);
  EXPECT_TRUE(point.reindexed && point.jogged && point.shifted && point.reclamped);
  EXPECT_EQ(point.two_sided, b.first_side != b.second_side);
  const double feed = 60.0 * 23.7 / 100.0;
  EXPECT_NEAR(all.speed[50], two_pi, 1e-9 * two_pi);
  EXPECT_NEAR(all.speed[150], 151.0 / 60.0 * two_pi, 1e-9 * two_pi);
  EXPECT_NEAR(all.velocity[50], feed, 1e-9 * feed);
  EXPECT_NEAR(all.velocity[150], -feed * 151.0 / 60.0, 1e-9 * feed);
}

INSTANTIATE_TEST_SUITE_P(SidesAndAngles, SceneOf,
                         ::testing::Combine(::testing::Values(0.0, 0.1, -0.25),
                                            ::testing::Values(Root::front, Root::rear),
                                            ::testing::Values(Root::front, Root::rear),
                                            ::testing::Values(0.0, 3.0)));

}  // namespace
}  // namespace trueaxis
