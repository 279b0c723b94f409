// SPDX-License-Identifier: Apache-2.0
// Readings whose surface is known by construction: a ball's centres about an axis of the part
// frame, turned into X_M, C and Z by Eq. 1.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "associate/files/stream_association.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
// Lengths of 40 mm: some operations of 40 × 2.2e-16 each.
constexpr double rounding_mm = 1e-12;

ProbeStream through(const std::vector<Point3>& points) {
  ProbeStream stream;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, y, z] = points[i];
    const bool behind = i % 3 == 0;  // X_M < 0 half a turn on is the same point
    stream.reading_mm.push_back(std::hypot(x, y) * (behind ? -1.0 : 1.0));
    stream.c_rad.push_back(std::atan2(y, x) + (behind ? 0.5 * turn : 0.0));
    stream.position_mm.push_back(z);
  }
  stream.source = "made.csv";
  return stream;
}

/// Axis (0.03, -0.02) at Z = 0 with slopes 1e-3 and -2e-3; with `radius` + `growth` s, and
/// `lobes_mm` cos 3θ.
std::vector<Point3> revolved(double radius, double growth, double lobes_mm) {
  const double n = 1.0 / std::sqrt(1.0 + 1e-6 + 4e-6), l = 1e-3 * n, m = -2e-3 * n;
  // Two directions at right angles to (l, m, n).
  const double a = std::hypot(n, l);
  const Point3 e{n / a, 0.0, -l / a}, f{-l * m / a, a, -m * n / a};
  std::vector<Point3> points;
  for (int section = 0; section < 5; ++section)
    for (int i = 0; i < 36; ++i) {
      const double s = -20.0 + 5.0 * section, t = turn * i / 36.0;
      const double r = radius + growth * s + lobes_mm * std::cos(3.0 * t);
      Point3 p{0.03 + s * l, -0.02 + s * m, s * n};
      for (std::size_t k = 0; k < 3; ++k) p[k] += r * (e[k] * std::cos(t) + f[k] * std::sin(t));
      points.push_back(p);
    }
  return points;
}

double number_of(const StreamAssociation& of, const std::string& name) {
  for (const SurfaceNumber& number : surface_numbers(of.surface, of.of_surface.feature))
    if (number.name == name) return number.value;
  return std::nan("");
}

TEST(StreamCriterion, AConeThroughABallsCentresIsTheOneThatTheBallTouches) {
  const double half_angle = 7.125 * rad_per_deg, ball = 1.5, radius = 25.0;
  for (const bool bore : {false, true}) {
    // The centres' cone is parallel: a ball's radius along the normal (Eq. 300).
    const double offset = (bore ? -ball : ball) / std::cos(half_angle);
    const ProbeStream stream = through(revolved(radius + offset, std::tan(half_angle), 0.0));
    for (const Criterion criterion : {Criterion::gaussian, Criterion::minimum_zone}) {
      const StreamAssociation got = associate_stream(stream, SurfaceKind::cone, criterion,
                                                     {.bore = bore, .ball_radius_mm = ball});
      ASSERT_EQ(got.of_centres.status, AssociationStatus::converged);
      EXPECT_NEAR(number_of(got, "x0"), 0.03, rounding_mm);
      EXPECT_NEAR(number_of(got, "y0"), -0.02, rounding_mm);
      EXPECT_NEAR(number_of(got, "l"), 1e-3 / std::sqrt(1.0 + 5e-6), 1e-13);
      EXPECT_NEAR(number_of(got, "m"), -2e-3 / std::sqrt(1.0 + 5e-6), 1e-13);
      EXPECT_NEAR(number_of(got, "half_angle"), 7.125, 1e-11);
      // The apex is 25/tan α = 200 mm away, 8 times the probed radius: rounding grows as much.
      EXPECT_NEAR(number_of(got, "k"), -radius / std::tan(half_angle), 64.0 * rounding_mm);
    }
  }
}

TEST(StreamCriterion, ThreeLobesOnACylinderHaveTheValuesOfTheirAmplitude) {
  const double a = 0.004, radius = 20.0, ball = 2.0;
  const ProbeStream stream = through(revolved(radius + ball, 0.0, a));
  const auto by = [&](Criterion criterion) {
    const StreamAssociation got =
        associate_stream(stream, SurfaceKind::cylinder, criterion, {.ball_radius_mm = ball});
    EXPECT_EQ(got.of_centres.status, AssociationStatus::converged);
    EXPECT_NEAR(number_of(got, "x0"), 0.03, 1e-9);
    EXPECT_NEAR(number_of(got, "y0"), -0.02, 1e-9);
    return got;
  };
  // Three crests and three valleys of every section are readings: every circle touches them.
  EXPECT_NEAR(by(Criterion::minimum_zone).of_surface.zone_mm, 2.0 * a, 1e-9);
  EXPECT_NEAR(number_of(by(Criterion::minimum_circumscribed), "radius"), radius + a, 1e-9);
  EXPECT_NEAR(number_of(by(Criterion::maximum_inscribed), "radius"), radius - a, 1e-9);
  EXPECT_NEAR(number_of(by(Criterion::gaussian), "radius"), radius, 1e-9);
  const StreamAssociation zone = by(Criterion::minimum_zone);
  const auto json = nlohmann::json::parse(stream_association_json(zone));
  EXPECT_EQ(json["criterion"], "minimum_zone");
  EXPECT_EQ(json["surface"]["id"], "cylinder");
  EXPECT_NEAR(json["surface"]["parameters"]["radius"]["value"].get<double>(), radius, 1e-9);
  EXPECT_GE(json["certificate"]["contacts"].size(), 4U);  // two outside, two inside at least
  // The certificate is of the centres, and says so.
  EXPECT_NE(association_certificate(zone.of_centres, zone.points).find("centres of the ball of 2"),
            std::string::npos);
}

// A gauge is at 0 where the surface is at its nominal radius: the ball's centre is then a ball
// further out, or in in a bore, and on the rear side at −X.
TEST(StreamCriterion, AGaugeReadsWhatIsMoreThanItsNominalRadius) {
  const double radius = 20.0, ball = 1.5, nominal = 19.9;
  for (const bool bore : {false, true})
    for (const bool rear : {false, true}) {
      const double out = bore ? -ball : ball, sign = rear ? -1.0 : 1.0;
      ProbeStream gauge = through(revolved(radius + out, 0.0, 0.0));
      for (std::size_t i = 0; i < gauge.size(); ++i) {
        if ((gauge.reading_mm[i] < 0.0) != rear)  // the same point half a turn on
          gauge.reading_mm[i] *= -1.0, gauge.c_rad[i] += 0.5 * turn;
        gauge.reading_mm[i] -= sign * (nominal + out);
      }
      gauge.indication = Indication::relative;
      gauge.nominal_radius_mm = nominal;
      gauge.setups.front().rear = rear;
      const StreamAssociation got =
          associate_stream(gauge, SurfaceKind::cylinder, Criterion::minimum_zone,
                           {.bore = bore, .ball_radius_mm = ball});
      EXPECT_NEAR(number_of(got, "x0"), 0.03, 100.0 * rounding_mm);
      EXPECT_NEAR(number_of(got, "y0"), -0.02, 100.0 * rounding_mm);
      EXPECT_NEAR(number_of(got, "radius"), radius, 100.0 * rounding_mm);
      EXPECT_NEAR(got.of_surface.zone_mm, 0.0, 100.0 * rounding_mm);
    }
}

TEST(StreamCriterion, AFaceLiesABallBelowItsCentres) {
  ProbeStream face;
  face.kind = StreamKind::face;
  const double n = 1.0 / std::sqrt(1.0 + 1e-4), ball = 1.0, d = -30.0;
  for (int i = 0; i < 40; ++i) {
    const double c = 0.7 * i, x = 5.0 + i;  // normal (0.01, 0, 1) n; centres at d + ball
    face.c_rad.push_back(c);
    face.position_mm.push_back(x);
    face.reading_mm.push_back((d + ball) / n - 0.01 * x * std::cos(c));
  }
  const StreamAssociation got =
      associate_stream(face, SurfaceKind::plane, Criterion::minimum_zone, {.ball_radius_mm = ball});
  EXPECT_NEAR(number_of(got, "l"), 0.01 * n, 1e-14);
  EXPECT_NEAR(number_of(got, "m"), 0.0, 1e-14);
  EXPECT_NEAR(number_of(got, "d"), d, rounding_mm);
}

TEST(StreamCriterion, WhatIsNoPointIsRefused) {
  const auto why = [](ProbeStream stream, SurfaceKind surface) {
    try {
      points_of_stream(stream, surface, {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  ProbeStream gauge = through(revolved(20.0, 0.1, 0.0));
  gauge.indication = Indication::relative;
  const std::string both = why(gauge, SurfaceKind::cone);
  EXPECT_NE(both.find("--nominal-radius"), std::string::npos) << both;
  EXPECT_NE(both.find("--ball-radius"), std::string::npos) << both;
  EXPECT_NE(why(gauge, SurfaceKind::plane).find("no Z_M"), std::string::npos);
  ProbeStream twice = through(revolved(20.0, 0.0, 0.0));
  twice.setup.assign(twice.size(), 1);
  twice.setup.back() = 2;
  EXPECT_NE(why(twice, SurfaceKind::cylinder).find("set-ups"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis
