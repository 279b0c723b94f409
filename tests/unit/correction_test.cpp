// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "correct/profile.hpp"
#include "format/reason_words.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {
namespace {

constexpr double pi = std::numbers::pi;

AxisEstimate tilted_axis() { return {{0.10, -0.06, 8e-4, 5e-4, 20.0}, {}}; }

TargetSurface cylinder(double z_start = 0.0, double z_end = 2.0) {
  return {TargetKind::cylinder, false, z_start, z_end, 20.0, 0.0, 0.0, 0.0, 0.0};
}
TargetSurface cone(double tan_half_angle) {
  return {TargetKind::cone, false, 60.0, 58.0, 25.0, tan_half_angle, 0.0, 0.0, 0.0};
}
TargetSurface face() { return {TargetKind::face, false, 0, 0, 0, 0, 5.0, 30.0, 28.0}; }

ToolSetup tool() {
  ToolSetup setup;
  setup.nose_radius_mm = 0.4;
  setup.height_mm = 0.05;
  setup.c_start_rad = 0.7;
  return setup;
}

TEST(Correction, OfAnAxisThatIsTheSpindlesIsZero) {
  for (TargetSurface target : {cylinder(), cone(0.1), cone(-5.0), face()}) {
    const Correction correction = make_correction({}, target, tool(), {});
    for (std::size_t i = 0; i < correction.rows.wanted_mm.size(); ++i) {
      ASSERT_NEAR(correction.rows.wanted_mm[i], 0.0, 1e-12);
      ASSERT_NEAR(correction.rows.command_mm[i], 0.0, 1e-12);
    }
    EXPECT_TRUE(correction.harmonics.empty());
    EXPECT_TRUE(correction.margin.follows) << words_of(correction.margin.breaks, "; ");
  }
}

TEST(Correction, OfACylinderIsItsClosedFormToThirdOrder) {
  // ΔX = Re{E(Z) e^{iC}} + H2 with E = x(Z) − i y(Z): to second order
  // x_e cos C + y_e sin C − (y_e cos C − x_e sin C)²/(2R) + (R/2)(slope along X)².
  ToolSetup setup = tool();
  setup.height_mm = 0.0;
  setup.nose_radius_mm = 0.0;
  const AxisEstimate axis = tilted_axis();
  const Correction correction = make_correction(axis, cylinder(0.0, 30.0), setup, {});
  const double radius = 20.0, e = 0.13;
  for (std::size_t i = 0; i < correction.rows.c_rad.size(); i += 7) {
    const double c = correction.rows.c_rad[i];
    const auto [x, y] = axis.axis.at(correction.rows.position_mm[i]);
    const double along = x * std::cos(c) + y * std::sin(c);
    const double across = y * std::cos(c) - x * std::sin(c);
    const double tilt = axis.axis.slope_x * std::cos(c) + axis.axis.slope_y * std::sin(c);
    const double second = -across * across / (2.0 * radius) + 0.5 * radius * tilt * tilt;
    // Next terms: e⁴/(8R³) and e·θ²: 1e-7 mm.
    ASSERT_NEAR(correction.rows.wanted_mm[i], along + second,
                std::pow(e, 4) / std::pow(radius, 3) + 2.0 * e * 1e-6);
  }
}

// The loop of the machine makes e^(gain + i lag) of what is commanded: the target axis.
TEST(Correction, OfACommandedAxisTheLoopMakesTheTargetAxis) {
  Correction correction;
  correction.axis = tilted_axis();
  correction.loop.gain = 0.03, correction.loop.lag_rad = -0.2;
  const Axis commanded = correction.commanded_axis(), &target = correction.axis.axis;
  const std::complex<double> loop = std::exp(std::complex(0.03, -0.2));
  const auto made = [&](double x, double y) { return loop * std::complex(x, y); };
  EXPECT_LT(std::abs(made(commanded.x_mm, commanded.y_mm) - std::complex(target.x_mm, target.y_mm)),
            1e-15);
  EXPECT_LT(std::abs(made(commanded.slope_x, commanded.slope_y) -
                     std::complex(target.slope_x, target.slope_y)),
            1e-17);
  EXPECT_EQ(commanded.z_ref_mm, target.z_ref_mm);
}

TEST(Correction, PutsTheNoseOnTheTargetSurface) {
  // An own check of tangency: the smallest distance from the nose's centre to the section of the
  // target in the rake plane, by golden-section search, is the nose radius.
  for (const bool bore : {false, true}) {
    for (TargetSurface target : {cylinder(), cone(0.3), cone(-3.0)}) {
      target.bore = bore;
      const Axis axis{0.10, -0.06, 8e-4, 5e-4, 20.0};
      const Profile profile(axis, target, tool());
      const auto [x_axis, y_axis] = axis.at(target.z_start_mm);
      const Revolved wanted{{x_axis, y_axis, axis.slope_x, axis.slope_y, target.z_start_mm},
                            target.radius_mm,
                            target.tan_half_angle};
      const Revolved nominal{
          {0, 0, 0, 0, target.z_start_mm}, target.radius_mm, target.tan_half_angle};
      for (double c = 0.0; c < 6.0; c += 0.9) {
        const double z = target.z_start_mm - 0.7;
        const auto distance_to = [&](const Revolved& surface, double x_centre) {
          double low = z - 2.0, high = z + 2.0;
          const auto distance = [&](double at) {
            return std::hypot(intersect(surface, c, at, 0.05).x_mm - x_centre, at - z);
          };
          for (int i = 0; i < 100; ++i) {
            const double a = low + 0.381966 * (high - low), b = low + 0.618034 * (high - low);
            (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
          }
          return distance(0.5 * (low + high));
        };
        // The distance grows by 1/sqrt(1 + s²) < 1 per step of the centre: a contraction.
        double x_nominal = intersect(nominal, c, z, 0.05).x_mm;
        for (int i = 0; i < 100; ++i) {
          x_nominal += (bore ? -1.0 : 1.0) * (0.4 - distance_to(nominal, x_nominal));
        }
        // Rounding of the search: distance is flat to sqrt(ε) at its minimum, so 1e-12 in value.
        EXPECT_NEAR(distance_to(wanted, x_nominal + profile.at(c, z)), 0.4, 1e-9) << c;
      }
    }
  }
}

TEST(Correction, NoseOfTheCatalogue) {
  // Eq. 109: the centre's offset r_n(√(1+s²) − 1), s = θ cos(C − φ) on a cylinder.
  ToolSetup setup = tool();
  setup.height_mm = 0.0;
  const Axis axis{0, 0, 2e-3, 0, 0};
  const Profile with(axis, cylinder(), setup);
  setup.nose_radius_mm = 0.0;
  const Profile without(axis, cylinder(), setup);
  for (double c = 0.0; c < 6.3; c += 0.3) {
    const double s = 2e-3 * std::cos(c);
    // Curvature of the section R θ²… changes it by r_n² of that: below 1e-11.
    EXPECT_NEAR(with.at(c, 1.0) - without.at(c, 1.0), 0.4 * (std::sqrt(1.0 + s * s) - 1.0), 1e-9);
  }
}

TEST(Correction, RowsRunAlongTheHelixAndReachTheEnd) {
  ToolSetup setup = tool();
  setup.sense = -1;
  setup.feed_mm_per_rev = 0.3;
  TargetSurface target = cylinder(10.0, 9.0);
  const CorrectionRows rows = make_correction(tilted_axis(), target, setup, {}).rows;
  // 1 mm in 0.3 mm/rev: the fourth revolution reaches the end, the fifth is cut there.
  ASSERT_EQ(rows.c_rad.size(), 5u * 360u);
  for (std::size_t i = 0; i < rows.c_rad.size(); ++i) {
    const double turns = static_cast<double>(i) / 360.0;
    ASSERT_NEAR(rows.c_rad[i], 0.7 - 2.0 * pi * turns, 1e-12);
    ASSERT_NEAR(rows.position_mm[i], std::max(9.0, 10.0 - 0.3 * turns), 1e-12);
    ASSERT_EQ(rows.revolution[i], static_cast<int>(i / 360));
  }
  EXPECT_EQ(rows.position_mm.back(), 9.0);
  // A whole number of revolutions reaches the end a row short: one more is cut there.
  setup.feed_mm_per_rev = 0.25;
  EXPECT_EQ(make_correction(tilted_axis(), target, setup, {}).rows.c_rad.size(), 5u * 360u);
}

TEST(Correction, IsContinuousWhereATableFrozenPerRevolutionSteps) {
  ToolSetup setup = tool();
  setup.feed_mm_per_rev = 0.2;
  const AxisEstimate axis{{0.0, 0.0, 1e-3, 0.0, 0.0}, {}};
  const Profile profile(axis.axis, cylinder(), setup);
  // Eq. 111: frozen at the Z of its start, a revolution ends θ f = 0.2 µm off at 1 mrad, 0.2
  // mm/rev.
  EXPECT_NEAR(profile.at(0.0, 0.4) - profile.at(0.0, 0.2), 1e-3 * 0.2, 1e-9);
  const CorrectionRows rows = make_correction(axis, cylinder(), setup, {}).rows;
  // The second difference of a 1-UPR amplitude A is A (2π/M)²; A grows to 2 µm here. Where the feed
  // stops it has θ f/M more.
  for (std::size_t i = 1; i + 1 < rows.wanted_mm.size(); ++i) {
    const double bend = rows.wanted_mm[i - 1] - 2.0 * rows.wanted_mm[i] + rows.wanted_mm[i + 1];
    const bool stops = rows.position_mm[i] == rows.position_mm[i + 1] &&
                       rows.position_mm[i - 1] != rows.position_mm[i];
    ASSERT_LT(std::abs(bend),
              1.1 * 2.3e-3 * std::pow(2.0 * pi / 360.0, 2) + (stops ? 1e-3 * 0.2 / 360.0 : 0.0))
        << i;
  }
}

TEST(Correction, ARearTurretWorksHalfATurnOn) {
  ToolSetup front = tool(), rear = tool();
  rear.angle_from_probe_rad = pi;
  for (const TargetSurface& target : {cone(0.2), face()}) {
    const Profile a(tilted_axis().axis, target, front), b(tilted_axis().axis, target, rear);
    for (double c = 0.0; c < 6.0; c += 0.7) {
      const double at = a.position_start_mm();
      EXPECT_NEAR(a.at(c + pi, at), b.at(c, at), 1e-12);
    }
  }
}

TEST(Correction, OfAFaceIsAPlaneThroughTheAxis) {
  ToolSetup setup = tool();
  setup.nose_radius_mm = 0.0;
  const AxisEstimate axis = tilted_axis();
  const CorrectionRows rows = make_correction(axis, face(), setup, {}).rows;
  EXPECT_DOUBLE_EQ(rows.position_mm.front(), 30.0);
  const auto [ax, ay] = axis.axis.at(5.0);
  for (std::size_t i = 0; i < rows.c_rad.size(); i += 11) {
    const double c = rows.c_rad[i], x = rows.position_mm[i], h = setup.height_mm;
    const double px = x * std::cos(c) - h * std::sin(c), py = x * std::sin(c) + h * std::cos(c);
    // The contact lies in the plane: (p − a)·(slope_x, slope_y, 1) = 0.
    EXPECT_NEAR((px - ax) * 8e-4 + (py - ay) * 5e-4 + rows.wanted_mm[i], 0.0, 1e-14);
  }
}

TEST(Correction, HarmonicsAreThoseOfTheEccentricityAtBothEnds) {
  for (const int sense : {1, -1}) {
    ToolSetup setup = tool();
    setup.sense = sense;
    setup.height_mm = 0.0;
    const AxisEstimate axis = tilted_axis();
    const Correction correction = make_correction(axis, cylinder(0.0, 40.0), setup, {});
    const auto first = std::find_if(correction.harmonics.begin(), correction.harmonics.end(),
                                    [](const CorrectionHarmonic& h) { return h.order == 1; });
    ASSERT_NE(first, correction.harmonics.end());
    // x cos C + y sin C = A cos(C − φ), A = |(x, y)|, φ = atan2(y, x); third order e³/R² below
    // 1e-6.
    const auto [x0, y0] = axis.axis.at(0.0);
    const auto [x1, y1] = axis.axis.at(40.0);
    EXPECT_NEAR(first->amplitude_start_mm, std::hypot(x0, y0), 1e-6);
    EXPECT_NEAR(first->amplitude_end_mm, std::hypot(x1, y1), 1e-6);
    EXPECT_NEAR(std::remainder(first->phase_start_rad - std::atan2(y0, x0), 2 * pi), 0.0, 1e-5);
    EXPECT_NEAR(std::remainder(first->phase_end_rad - std::atan2(y1, x1), 2 * pi), 0.0, 1e-5);
    for (const CorrectionHarmonic& h : correction.harmonics) {
      EXPECT_LE(h.order, 8);
      EXPECT_GE(std::max(std::abs(h.amplitude_start_mm), std::abs(h.amplitude_end_mm)), 1e-6);
    }
  }
}

TEST(Correction, ATargetThatTheToolMissesIsRefused) {
  ToolSetup setup = tool();
  setup.height_mm = 21.0;
  EXPECT_THROW(make_correction(tilted_axis(), cylinder(), setup, {}), Refusal);
}

// The nose of 0.4 mm about its centre stays on this side of a shoulder, at either end of a cut that
// is overrun by 0.2 mm.
TEST(Correction, TheNoseStaysBeforeAShoulder) {
  for (const bool backwards : {false, true})
    for (const auto& [shoulder_mm, fits] :
         {std::pair{2.61, true}, {2.59, false}, {-0.41, true}, {-0.39, false}, {1.0, false}}) {
      TargetSurface target = cylinder();
      target.overrun_mm = 0.2;
      target.shoulder_mm = shoulder_mm;
      if (backwards) {
        std::swap(target.z_start_mm, target.z_end_mm);
        target.shoulder_mm = 2.0 - shoulder_mm;
      }
      if (fits)
        EXPECT_NO_THROW(make_correction({}, target, tool(), {})) << shoulder_mm;
      else
        EXPECT_THROW(make_correction({}, target, tool(), {}), Refusal) << shoulder_mm;
    }
}

// In the last revolution there is no feed, and the amplitude of the tilted axis is constant. The
// command is then what was wanted over response and interpolation (Eqs. 114, 115).
TEST(Correction, WithoutFeedTheCommandHasNoRate) {
  const Actuator actuator;
  const ToolSetup setup;
  const AxisEstimate tilted{{0.3, 0.0, 0.0, 8e-3, 0.0}, {}};
  const CorrectionRows rows = make_correction(tilted, cylinder(), setup, actuator).rows;
  const auto per_rev = static_cast<std::size_t>(setup.rows_per_revolution);
  const std::size_t count = rows.wanted_mm.size();
  ASSERT_EQ(rows.position_mm[count - per_rev], rows.position_mm.back());
  std::complex<double> wanted, command;
  for (std::size_t i = count - per_rev; i < count; ++i) {
    wanted += rows.wanted_mm[i] * std::polar(1.0, -rows.c_rad[i]);
    command += rows.command_mm[i] * std::polar(1.0, -rows.c_rad[i]);
  }
  const double x = pi / setup.rows_per_revolution, kept = std::pow(std::sin(x) / x, 2);
  const std::complex<double> expected = 1.0 / (kept * actuator.response(setup.speed_rpm / 60.0));
  EXPECT_LT(std::abs(command / wanted - expected), 1e-8);
}

}  // namespace
}  // namespace trueaxis
