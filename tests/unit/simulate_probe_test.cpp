// SPDX-License-Identifier: Apache-2.0
// The virtual lathe against closed forms that it does not contain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "simulate/contact.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {
namespace {

// Readings are roots to the last bits of numbers near 50: 1e-13 is a few units in the last place of
// the sums that they come from.
constexpr double exact_mm = 1e-12;

Scenario dwell(double radius_mm, double z_mm = 0.0, double readings = 360.0) {
  Scenario scenario;
  scenario.part.radius_mm = radius_mm;
  PlannedPass pass;
  pass.start_mm = pass.end_mm = z_mm;
  pass.revolutions = 1.0 - 0.5 / readings;  // every angle once
  pass.readings_per_revolution = readings;
  scenario.plan.passes = {pass};
  return scenario;
}

// Amplitude and phase of cos(nC − phase) over one full revolution; n = 0: the mean.
std::complex<double> harmonic(const ProbeStream& stream, int n) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    sum += stream.reading_mm[i] * std::polar(1.0, n * stream.c_rad[i]);
  }
  return sum * ((n == 0 ? 1.0 : 2.0) / static_cast<double>(stream.size()));
}

TEST(SimulateProbe, EccentricCircleIsTheClosedFormUpToNearlyTheRadius) {
  for (const double e : {0.0, 0.2, 10.0, 39.999}) {
    Scenario scenario = dwell(40.0);
    const double phase = 0.7;
    scenario.part.x0_mm = e * std::cos(phase);
    scenario.part.y0_mm = e * std::sin(phase);
    const ProbeStream stream = simulate(scenario);
    ASSERT_EQ(stream.size(), 360u);
    for (std::size_t i = 0; i < stream.size(); ++i) {
      const double angle = stream.c_rad[i] - phase;
      const double across = e * std::sin(angle);
      const double x = e * std::cos(angle) + std::sqrt(1600.0 - across * across);
      // A grazing line turns rounding of the part's place (5e-15) into 1/cos of the incidence.
      const double slope = std::sqrt(1.0 - across * across / 1600.0);
      EXPECT_NEAR(stream.reading_mm[i], x, 1e-13 / slope) << "e = " << e << ", i = " << i;
    }
  }
}

TEST(SimulateProbe, RearSideAndBoreReadTheirOwnWalls) {
  Scenario scenario = dwell(40.0);
  scenario.part.x0_mm = 3.0;
  scenario.plan.setups = {Chucking{}};
  scenario.plan.setups[0].rear = true;
  const ProbeStream rear = simulate(scenario);
  scenario.plan.setups.clear();
  scenario.part.bore = true;
  const ProbeStream bore = simulate(scenario);
  for (std::size_t i = 0; i < rear.size(); ++i) {
    const double a = 3.0 * std::cos(rear.c_rad[i]), b = 3.0 * std::sin(rear.c_rad[i]);
    EXPECT_NEAR(rear.reading_mm[i], a - std::sqrt(1600.0 - b * b), exact_mm);
    EXPECT_NEAR(bore.reading_mm[i], a + std::sqrt(1600.0 - b * b), exact_mm);
  }
  EXPECT_EQ(rear.metadata.at("setup.1.side"), "rear");
}

TEST(SimulateProbe, EccentricCircleHasItsSecondHarmonic) {
  Scenario scenario = dwell(40.0);
  scenario.part.x0_mm = 0.2;
  const ProbeStream stream = simulate(scenario);
  // Eq. 12: H1 = e, H2 = e²/4R, DC −e²/4R; next terms are of order e⁴/R³ = 2.5e-8 mm.
  EXPECT_NEAR(std::abs(harmonic(stream, 1)), 0.2, exact_mm);
  EXPECT_NEAR(harmonic(stream, 2).real(), 0.04 / 160.0, 3e-8);
  EXPECT_NEAR(harmonic(stream, 0).real(), 40.0 - 0.04 / 160.0, 3e-8);
}

TEST(SimulateProbe, InclinedCylinderAndTiltedConeHaveTheirHarmonics) {
  Scenario scenario = dwell(50.0);
  scenario.part.l = 0.001;
  // Rθ²/4 = 12.5 nm (the section is an ellipse); next order Rθ⁴ = 5e-11.
  EXPECT_NEAR(std::abs(harmonic(simulate(scenario), 2)), 50.0 * 1e-6 / 4.0, 1e-10);

  scenario.part.kind = PartKind::cone;
  scenario.part.radius_at_mm = 0.0;
  scenario.part.half_angle_rad = std::atan(0.1);
  const ProbeStream cone = simulate(scenario);
  // H1 = R θ tanα = 5 µm, H2 = (Rθ²/4)(1 + 2 tan²α); next order Rθ³ = 5e-8 for H1.
  EXPECT_NEAR(std::abs(harmonic(cone, 1)), 0.005, 5e-8);
  EXPECT_NEAR(std::abs(harmonic(cone, 2)), 12.5e-6 * 1.02, 1e-9);
}

TEST(SimulateProbe, ConeByItsApexOpensEitherWayUpToEightyDegrees) {
  for (const double half_angle_deg : {1.0, 15.5, 80.0}) {
    for (const double apex : {402.0, -402.0}) {
      Scenario scenario = dwell(0.0, 10.0);
      scenario.part.kind = PartKind::cone;
      scenario.part.apex_mm = apex;
      scenario.part.half_angle_rad = half_angle_deg * rad_per_deg;
      const double radius = std::abs(10.0 - apex) * std::tan(half_angle_deg * rad_per_deg);
      const ProbeStream centred = simulate(scenario);
      for (const double x : centred.reading_mm) EXPECT_NEAR(x, radius, 1e-15 * radius * 8.0);

      scenario.part.x0_mm = 0.9 * radius;
      scenario.part.l = 0.0002, scenario.part.m = 0.0009;
      for (const PlannedPass& pass : scenario.plan.passes) ASSERT_EQ(pass.start_mm, 10.0);
      const ProbeStream tilted = simulate(scenario);
      // Every reading lies on the cone through its apex: cos of the angle to the axis.
      const double n = std::sqrt(1.0 - 0.0002 * 0.0002 - 0.0009 * 0.0009);
      for (std::size_t i = 0; i < tilted.size(); ++i) {
        const double x = tilted.reading_mm[i] * std::cos(tilted.c_rad[i]) - 0.9 * radius;
        const double y = tilted.reading_mm[i] * std::sin(tilted.c_rad[i]);
        const double ax = x - apex * 0.0002, ay = y - apex * 0.0009, az = 10.0 - apex * n;
        const double along = ax * 0.0002 + ay * 0.0009 + az * n;
        const double length = std::sqrt(ax * ax + ay * ay + az * az);
        EXPECT_NEAR(std::abs(along), length * std::cos(half_angle_deg * rad_per_deg), 1e-9);
        EXPECT_LT(along * apex, 0.0) << "the mirrored nappe";
      }
    }
  }
}

TEST(SimulateProbe, HeightTurnsTheContact) {
  Scenario scenario = dwell(40.0);
  scenario.effects = {{"probe.height", {{"height_mm", 1.0}}},
                      {"part.roundness", {{"order", 3}, {"amplitude_mm", 1e-5}}}};
  scenario.part.x0_mm = 1e-6;
  const ProbeStream stream = simulate(scenario);
  const double turn = std::asin(1.0 / 40.0);
  // x = e cos(C + turn)/cos(turn) …: the phase turns by asin(h/R); H1 and H3 are small, so their
  // second orders (1e-5²/40) vanish.
  EXPECT_NEAR(std::arg(harmonic(stream, 1)), -turn, 1e-6);
  EXPECT_NEAR(std::arg(harmonic(stream, 3)), -3.0 * turn, 1e-6);
  EXPECT_NEAR(harmonic(stream, 0).real(), std::sqrt(1600.0 - 1.0), 1e-9);
}

TEST(SimulateProbe, BallStandsOffByItsRadiusOverCosAlpha) {
  for (const bool bore : {false, true}) {
    Scenario point = dwell(40.0);
    point.part.kind = PartKind::cone;
    point.part.bore = bore;
    point.part.half_angle_rad = 20.0 * rad_per_deg;
    point.part.x0_mm = 0.5, point.part.l = 0.003, point.part.m = -0.002;
    Scenario ball = point;
    ball.probe.ball_radius_mm = 1.5;
    point.part.radius_mm += (bore ? -1.5 : 1.5) / std::cos(20.0 * rad_per_deg);
    const ProbeStream expected = simulate(point), centre = simulate(ball);
    for (std::size_t i = 0; i < centre.size(); ++i) {
      // The normal is found to 1e-8 (differences of 1e-4 mm); it enters to second order.
      EXPECT_NEAR(centre.reading_mm[i], expected.reading_mm[i], 1e-11) << "bore " << bore;
    }
  }
}

// The centre of a ball is a radius off the wall at the least: the farthest that any point of the
// wave lets it go, here by points 0.01 µm apart: (a k² + 1/R) (0.005 µm)²/2 = 7e-11 mm short of it.
TEST(SimulateProbe, BallRidesOnTheCrestsOfAWaveThatBendsMoreThanItDoes) {
  constexpr double wave_mm = 0.15;
  for (const double a_mm : {1e-4, 3e-4, 3e-3}) {
    for (const double side : {1.0, -1.0}) {
      Scenario scenario = dwell(40.0, 10.0, 40.0);
      scenario.plan.passes[0].end_mm = 10.4;
      scenario.probe.ball_radius_mm = 3.0;
      scenario.part.bore = side < 0.0;
      scenario.effects = {{"part.waviness", {{"amplitude_mm", a_mm}, {"wavelength_mm", wave_mm}}}};
      const ProbeStream stream = simulate(scenario);
      for (std::size_t i = 0; i < stream.size(); ++i) {
        double stop_mm = -std::numeric_limits<double>::infinity();
        for (double off = -0.5 * wave_mm; off < 0.5 * wave_mm; off += 1e-5)
          stop_mm = std::max(
              stop_mm, side * a_mm * std::cos(two_pi * (stream.position_mm[i] + off) / wave_mm) +
                           std::sqrt(9.0 - off * off));
        EXPECT_NEAR(stream.reading_mm[i], 40.0 + side * stop_mm, 1e-10) << a_mm << " mm, " << side;
      }
    }
  }
}

TEST(SimulateProbe, FaceReadsItsPlane) {
  Scenario scenario = dwell(0.0, 30.0);
  scenario.part = Part{};
  scenario.part.kind = PartKind::face;
  scenario.part.l = 0.002, scenario.part.m = -0.001, scenario.part.d_mm = 12.0;
  scenario.part.x0_mm = 0.3;
  const ProbeStream stream = simulate(scenario);
  EXPECT_EQ(stream.kind, StreamKind::face);
  const double n = std::sqrt(1.0 - 5e-6);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double x = 30.0 * std::cos(stream.c_rad[i]), y = 30.0 * std::sin(stream.c_rad[i]);
    EXPECT_NEAR(0.002 * x - 0.001 * y + n * stream.reading_mm[i], 12.0, exact_mm);
  }
}

TEST(SimulateProbe, RelativeGaugeHidesAConstant) {
  Scenario scenario = dwell(40.0);
  scenario.probe.relative_zero_mm = 39.9;
  scenario.probe.nominal_radius_mm = 40.0;
  const ProbeStream stream = simulate(scenario);
  EXPECT_EQ(stream.indication, Indication::relative);
  EXPECT_EQ(stream.nominal_radius_mm, 40.0);
  for (const double x : stream.reading_mm) EXPECT_NEAR(x, 0.1, exact_mm);
}

TEST(SimulateProbe, NoNumberHasNoContactAndTheSearchForItEnds) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto gap = [&](double) { return none; };
  EXPECT_FALSE(root_near(gap, 0.0));
  EXPECT_FALSE(root_outside(gap, 0.0, 100.0));
  EXPECT_FALSE(root_from_outside(gap, 0.0, 1.0));
  EXPECT_FALSE(root_from_outside(gap, none, 1.0));
}

TEST(SimulateProbe, AMissedPartIsAnInputError) {
  Scenario scenario = dwell(40.0);
  scenario.effects = {{"probe.height", {{"height_mm", 40.5}}}};
  EXPECT_THROW(simulate(scenario), InputError);
  scenario.effects = {{"probe.hight", {}}};
  EXPECT_THROW(simulate(scenario), InputError);
  scenario.effects = {{"probe.height", {{"height_mm", 1.0}, {"width_mm", 1.0}}}};
  EXPECT_THROW(simulate(scenario), InputError);
  scenario.effects = {{"probe.height", {}}};
  EXPECT_THROW(simulate(scenario), InputError);
}

}  // namespace
}  // namespace trueaxis::virtual_lathe
