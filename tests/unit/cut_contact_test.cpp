// SPDX-License-Identifier: Apache-2.0
// The table against the virtual cut, which shares no formula with it: what the tool touches is the
// target about its axis, from the target's start to its end and not beyond.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "trueaxis/correction.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

struct Case {
  double half_angle_deg = 0.0;
  bool opens_plus = true, bore = false;
  double z_start = 60.0, z_end = 57.0;
  double height_mm = 0.0, angle_deg = 0.0;
  int sense = 1;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.half_angle_deg << " deg " << (c.opens_plus ? "+z" : "-z") << (c.bore ? " bore" : "")
       << " from " << c.z_start << " height " << c.height_mm << " at " << c.angle_deg;
}

constexpr double nose_mm = 0.8, tilt = 1e-3;

/// 0.1 mm along the wall; at 80° less, where the nose reaches r (1 − sin 80°) past its contact
/// only.
double feed_of(const Case& c) {
  return (c.half_angle_deg > 70.0 ? 0.03 : 0.1) * std::cos(c.half_angle_deg * rad_per_deg);
}

TargetSurface target_of(const Case& c) {
  const double t = std::tan(c.half_angle_deg * rad_per_deg) * (c.opens_plus ? 1.0 : -1.0);
  const bool narrows = t * (c.z_end - c.z_start) < 0.0;
  TargetSurface target;
  target.kind = c.half_angle_deg > 0.0 ? TargetKind::cone : TargetKind::cylinder;
  target.bore = c.bore;
  target.z_start_mm = c.z_start, target.z_end_mm = c.z_end;
  target.radius_mm = narrows ? 30.0 : 20.0;
  target.tan_half_angle = t;
  return target;
}

ToolSetup tool_of(const Case& c) {
  ToolSetup tool;
  tool.nose_radius_mm = nose_mm, tool.feed_mm_per_rev = feed_of(c);
  tool.height_mm = c.height_mm, tool.angle_from_probe_rad = c.angle_deg * rad_per_deg;
  tool.sense = c.sense, tool.c_start_rad = 0.3;
  return tool;
}

virtual_lathe::CutProgram program_of(const TargetSurface& target, const ToolSetup& tool) {
  virtual_lathe::CutProgram program;
  program.target.kind = target.kind == TargetKind::face   ? virtual_lathe::CutKind::face
                        : target.kind == TargetKind::cone ? virtual_lathe::CutKind::cone
                                                          : virtual_lathe::CutKind::cylinder;
  const bool face = target.kind == TargetKind::face;
  program.target.bore = target.bore;
  program.target.start_mm = face ? target.radius_start_mm : target.z_start_mm;
  program.target.end_mm = face ? target.radius_end_mm : target.z_end_mm;
  program.target.z_face_mm = target.z_face_mm;
  program.target.radius_mm = target.radius_mm;
  program.target.half_angle_rad = std::atan(target.tan_half_angle);
  program.tool = {tool.nose_radius_mm, tool.height_mm, tool.angle_from_probe_rad,
                  tool.speed_rpm,      tool.sense,     tool.feed_mm_per_rev,
                  tool.c_start_rad};
  program.use = virtual_lathe::CutUse::wanted;
  program.actuator.perfect = true;
  return program;
}

virtual_lathe::CutTable table_of(const Correction& correction) {
  const CorrectionRows& rows = correction.rows;
  return {correction.target.kind == TargetKind::face,
          rows.revolution,
          rows.position_mm,
          rows.c_rad,
          rows.wanted_mm,
          rows.command_mm};
}

/// Distance from a line of a point of the part.
double distance_mm(const Axis& axis, double x, double y, double z) {
  const Eigen::Vector3d direction = Eigen::Vector3d(axis.slope_x, axis.slope_y, 1.0).normalized();
  return Eigen::Vector3d(x - axis.x_mm, y - axis.y_mm, z - axis.z_ref_mm).cross(direction).norm();
}

/// Height of a point along a line, from the line's point at z.
double height_mm(const Axis& axis, double x, double y, double z, double z_from) {
  const auto [x_from, y_from] = axis.at(z_from);
  const Eigen::Vector3d direction = Eigen::Vector3d(axis.slope_x, axis.slope_y, 1.0).normalized();
  return Eigen::Vector3d(x - x_from, y - y_from, z - z_from).dot(direction);
}

class CutContact : public ::testing::TestWithParam<Case> {};

TEST_P(CutContact, RunsOverTheTargetAndNotBeyond) {
  const Case& c = GetParam();
  const TargetSurface target = target_of(c);
  const ToolSetup tool = tool_of(c);
  const Axis axis{0.08, -0.06, tilt, -0.5 * tilt, 50.0};
  const Correction correction = make_correction({axis, {}}, target, tool, {});
  virtual_lathe::CutProgram program = program_of(target, tool);
  program.runs_on = false;
  const virtual_lathe::CutPart part(program, table_of(correction));

  const double t = target.tan_half_angle;
  // Every point that is left within the target is on the target or outside of it, where the nose
  // touched it on it: over a turn of the feed the least material left is 0.
  const auto stands_mm = [&](double theta, double z) {
    const double r = part.surface_mm(theta, z);
    const double x = r * std::cos(theta), y = r * std::sin(theta);
    const double wanted = target.radius_mm + t * height_mm(axis, x, y, z, target.z_start_mm);
    return (distance_mm(axis, x, y, z) - wanted) * (c.bore ? -1.0 : 1.0) / std::hypot(1.0, t);
  };
  const double up = c.z_end > c.z_start ? 1.0 : -1.0;
  const double length = std::abs(c.z_end - c.z_start), feed_mm = feed_of(c);
  /// The least material left over one feed from there, and where.
  const auto least_about = [&](double theta, double from) {
    double least = 1e9, at = from;
    const int steps = 60;
    for (int i = 0; i <= steps; ++i) {
      const double z = c.z_start + up * (from + feed_mm * i / steps);
      if (const double stands = stands_mm(theta, z); stands < least) least = stands, at = z;
    }
    return boost::math::tools::brent_find_minima([&](double z) { return stands_mm(theta, z); },
                                                 at - feed_mm / steps, at + feed_mm / steps, 40);
  };
  // Between two rows, joined by a line, A (π/360)²/2 = 4 nm of A = 0.11 mm are missing; at the rows
  // themselves the goal is 0.1 nm. The edge of a row is at asin(h/r) on.
  for (int i = 0; i < 12; ++i) {
    const double at_row = tool.c_start_rad + tool.sense * two_pi * 31.0 * i / 360.0;
    for (const double from : {feed_mm, 0.5 * length, length - 2.0 * feed_mm}) {
      double theta = at_row + tool.angle_from_probe_rad, z = c.z_start + up * from, least = 1.0;
      for (int step = 0; step < 3; ++step) {
        theta =
            at_row + tool.angle_from_probe_rad + std::asin(c.height_mm / part.surface_mm(theta, z));
        std::tie(z, least) = least_about(theta, from);
      }
      EXPECT_NEAR(least, 0.0, 1e-7) << "C " << at_row << " from " << from;
    }
  }
  // The nose's circle over the wall at d along Z from its contact, across the wall. A bore is the
  // mirror image.
  const auto circle_mm = [&](double d) {
    const double slope = c.bore ? -t : t, secant = std::hypot(1.0, slope);
    const double off = d + nose_mm * slope / secant;
    return (nose_mm / secant - std::sqrt(nose_mm * nose_mm - off * off) - slope * d) / secant;
  };
  // The tilt moves the contact by r·tilt, and the first and the last contact at an angle lie up to
  // one feed within the ends.
  const double moved = 2.0 * nose_mm * tilt;
  for (double theta = 0.1; theta < 6.3; theta += 0.7) {
    for (const auto& [end, out] : {std::pair{c.z_start, -up}, std::pair{c.z_end, up}}) {
      EXPECT_LT(stands_mm(theta, end), circle_mm(out * (feed_mm + moved))) << theta << ' ' << end;
      for (const double d : {0.3 * feed_mm, feed_mm, 2.0 * feed_mm}) {
        const double stands = stands_mm(theta, end + out * d);
        if (std::isnan(stands)) continue;  // the nose never was there
        EXPECT_GT(stands, circle_mm(out * std::max(0.0, d - moved)) - 1e-6) << theta << ' ' << d;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cuts, CutContact,
    ::testing::Values(Case{}, Case{.height_mm = 0.3}, Case{.bore = true, .sense = -1},
                      Case{.half_angle_deg = 1}, Case{.half_angle_deg = 30},
                      Case{.half_angle_deg = 30, .opens_plus = false},
                      Case{.half_angle_deg = 30, .z_start = 57, .z_end = 60},
                      Case{.half_angle_deg = 30, .opens_plus = false, .z_start = 57, .z_end = 60},
                      Case{.half_angle_deg = 30, .bore = true},
                      Case{.half_angle_deg = 30, .opens_plus = false, .bore = true},
                      Case{.half_angle_deg = 30, .bore = true, .z_start = 57, .z_end = 60},
                      Case{.half_angle_deg = 30, .height_mm = 0.3, .angle_deg = 180},
                      Case{.half_angle_deg = 45, .height_mm = -0.3, .sense = -1},
                      Case{.half_angle_deg = 60, .z_end = 58.5},
                      Case{.half_angle_deg = 60, .bore = true, .z_end = 58.5, .sense = -1},
                      Case{.half_angle_deg = 80, .z_end = 59.2},
                      Case{.half_angle_deg = 80, .bore = true, .z_end = 59.2}));

// The quoted case: a 60° cone (half angle 60°, nose 0.8 mm) kept 0.8 sin 60° = 0.69 mm uncut at its
// start and was overrun by as much at the shoulder.
TEST(CutContactRange, OfTheNosesCentreIsTheTargetsLessTheNose) {
  TargetSurface target = target_of({.half_angle_deg = 60});
  ToolSetup tool = tool_of({});
  const Correction cone = make_correction({}, target, tool, {});
  EXPECT_NEAR(cone.position_start_mm, 60.0 - 0.8 * std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_NEAR(cone.position_end_mm, 57.0 - 0.8 * std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_EQ(cone.rows.position_mm.front(), cone.position_start_mm);
  target.bore = true;
  const Correction bore = make_correction({}, target, tool, {});
  EXPECT_NEAR(bore.position_start_mm, 60.0 + 0.8 * std::sqrt(3.0) / 2.0, 1e-12);
  const Correction cylinder = make_correction({}, target_of({}), tool, {});
  EXPECT_EQ(cylinder.position_start_mm, 60.0);
  EXPECT_EQ(cylinder.position_end_mm, 57.0);
}

// A face is touched at the X of the nose's centre, and is at z_mm on the target axis.
TEST(CutContactRange, OfAFaceIsThatOfXAndItsZHoldsOnTheTargetAxis) {
  TargetSurface face;
  face.kind = TargetKind::face;
  face.z_face_mm = 5.0, face.radius_start_mm = 30.0, face.radius_end_mm = 27.0;
  const Axis axis{0.5, -0.3, 4e-3, 2e-3, 100.0};
  for (const double height : {0.0, 0.3}) {
    ToolSetup tool = tool_of({.height_mm = height});
    Actuator strong;
    strong.stroke_mm = 5.0;
    const Correction correction = make_correction({axis, {}}, face, tool, strong);
    EXPECT_EQ(correction.position_start_mm, 30.0);
    EXPECT_EQ(correction.position_end_mm, 27.0);
    const virtual_lathe::CutPart part(program_of(face, tool), table_of(correction));
    const auto [x_axis, y_axis] = axis.at(5.0);
    for (int i = 0; i < 12; ++i) {
      const double theta = tool.c_start_rad + two_pi * 31.0 * i / 360.0;
      double least = 1e9, through_spindle = 1e9;
      for (int k = 0; k <= 4000; ++k) {
        const double r = 28.0 + 0.1 * k / 4000.0, z = part.surface_mm(theta, r);
        const double x = r * std::cos(theta), y = r * std::sin(theta);
        least = std::min(least, z - (5.0 - 4e-3 * (x - x_axis) - 2e-3 * (y - y_axis)));
        through_spindle = std::min(through_spindle, z - (5.0 - 4e-3 * x - 2e-3 * y));
      }
      // Interpolation of the rows: 5 nm of A = 0.13 mm. The tool's height h shifts an edge of the
      // face along itself only.
      EXPECT_NEAR(least, 0.0, 6e-6) << theta;
      // About the spindle axis it is off by slope times offset: z_mm is not that of this axis.
      EXPECT_NEAR(through_spindle, 4e-3 * x_axis + 2e-3 * y_axis, 6e-6);
      EXPECT_GT(std::abs(through_spindle), 3e-4);
    }
  }
}

}  // namespace
}  // namespace trueaxis
