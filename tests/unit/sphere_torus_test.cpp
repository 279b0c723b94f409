// SPDX-License-Identifier: Apache-2.0
// A sphere and a torus on a lathe. Readings are made from points of the surface by its own angles,
// turned into X_M, C and Z by Eq. 1: no line is intersected.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "associate/files/stream_association.hpp"
#include "fit/associate.hpp"
#include "fit/joint_model.hpp"
#include "fit/place_set_ups.hpp"
#include "job/evidence.hpp"
#include "surface/catalogue.hpp"
#include "surface/surface.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
constexpr double turn = 2.0 * std::numbers::pi;
// Some operations on lengths of 50 mm, 50 × 2.2e-16 each, and the fit's condition of about 10.
constexpr double rounding_mm = 1e-11;

void probe(const Vector3d& point, ProbeStream& stream) {
  stream.reading_mm.push_back(std::hypot(point.x(), point.y()));
  stream.c_rad.push_back(std::atan2(point.y(), point.x()));
  stream.position_mm.push_back(point.z());
}

const Vector3d centre(0.12, -0.08, 31.5);

/// A band of 50° to either side of the equator.
ProbeStream sphere(double path_radius_mm) {
  ProbeStream stream;
  for (int band = -5; band <= 5; ++band)
    for (int i = 0; i < 40; ++i) {
      const double up = 10.0 * band * std::numbers::pi / 180.0, t = turn * i / 40.0;
      probe(centre + path_radius_mm * Vector3d(std::cos(up) * std::cos(t),
                                               std::cos(up) * std::sin(t), std::sin(up)),
            stream);
    }
  return stream;
}

/// A tube about a circle at right angles to a tilted axis. @param inner towards the axis
ProbeStream torus(double radius_mm, double tube_mm, bool inner) {
  const Vector3d d = Vector3d(8e-4, -5e-4, 1.0).normalized();
  const Vector3d e = Vector3d(1.0, 0.0, -d.x() / d.z()).normalized(), f = d.cross(e);
  ProbeStream stream;
  for (int i = 0; i < 60; ++i)
    for (int k = -4; k <= 4; ++k) {
      const double t = turn * i / 60.0, along = 12.0 * k * std::numbers::pi / 180.0;
      const double r = radius_mm + (inner ? -1.0 : 1.0) * tube_mm * std::cos(along);
      probe(centre + r * (std::cos(t) * e + std::sin(t) * f) + tube_mm * std::sin(along) * d,
            stream);
    }
  return stream;
}

TEST(Sphere, IsFoundUnderTheBallOfAProbe) {
  for (const bool bore : {false, true}) {
    const double radius = 25.0, ball = 1.5;
    FitOptions options;
    options.surface = SurfaceKind::sphere;
    options.bore = bore;
    options.ball_radius_mm = ball;
    const ProbeStream stream = sphere(radius + (bore ? -ball : ball));
    const FitResult found = fit(stream, options);
    ASSERT_EQ(found.status, FitStatus::converged) << found.message;
    EXPECT_NEAR(found.parameter("x0").value, centre.x(), rounding_mm);
    EXPECT_NEAR(found.parameter("y0").value, centre.y(), rounding_mm);
    EXPECT_NEAR(found.parameter("z0").value, centre.z(), rounding_mm);
    EXPECT_NEAR(found.parameter("radius").value, radius, rounding_mm);
    const StreamAssociation zone =
        associate_stream(stream, SurfaceKind::sphere, Criterion::minimum_zone,
                         {.bore = bore, .ball_radius_mm = ball});
    for (const SurfaceNumber& number : surface_numbers(zone.surface, zone.of_surface.feature))
      EXPECT_NEAR(number.value, found.parameter(number.name).value, rounding_mm) << number.name;
  }
}

TEST(Torus, GrooveAndBeadOfShaftAndBore) {
  for (const bool bore : {false, true})
    for (const bool inner : {false, true}) {
      const double radius = 30.0, tube = 6.0, ball = 1.0;
      // The ball is in the tube where the material is outside of it: a shaft's groove faces the
      // axis, a bore's does not.
      const double path = inner != bore ? tube - ball : tube + ball;
      FitOptions options;
      options.surface = SurfaceKind::torus;
      options.bore = bore;
      options.ball_radius_mm = ball;
      const ProbeStream stream = torus(radius, path, inner);
      const FitResult found = fit(stream, options);
      ASSERT_EQ(found.status, FitStatus::converged) << found.message;
      const double n = 1.0 / std::sqrt(1.0 + 8e-4 * 8e-4 + 5e-4 * 5e-4);
      const double along = centre.z() / n;  // from where the axis crosses Z = 0
      EXPECT_NEAR(found.parameter("l").value, 8e-4 * n, rounding_mm);
      EXPECT_NEAR(found.parameter("m").value, -5e-4 * n, rounding_mm);
      EXPECT_NEAR(found.parameter("x0").value, centre.x() - 8e-4 * centre.z(), 10 * rounding_mm);
      EXPECT_NEAR(found.parameter("y0").value, centre.y() + 5e-4 * centre.z(), 10 * rounding_mm);
      EXPECT_NEAR(found.parameter("z0").value, along, 10 * rounding_mm);
      EXPECT_NEAR(found.parameter("radius").value, radius, 10 * rounding_mm);
      EXPECT_NEAR(found.parameter("minor_radius").value, tube, 10 * rounding_mm);
      const StreamAssociation orthogonal = associate_stream(
          stream, SurfaceKind::torus, Criterion::gaussian, {.bore = bore, .ball_radius_mm = ball});
      for (const SurfaceNumber& number :
           surface_numbers(orthogonal.surface, orthogonal.of_surface.feature))
        EXPECT_NEAR(number.value, found.parameter(number.name).value, 10 * rounding_mm)
            << number.name;
    }
}

// A ball is met at the other side of the spindle by half a turn. The same surface with the same u.
TEST(SphereTorus, AreTheSameFromBehind) {
  for (const SurfaceKind surface : {SurfaceKind::sphere, SurfaceKind::torus}) {
    ProbeStream stream = surface == SurfaceKind::sphere ? sphere(25.0) : torus(30.0, 6.0, true);
    FitOptions options;
    options.surface = surface;
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal(0.0, 1e-3);
    for (double& x : stream.reading_mm) x += normal(engine);
    const FitResult front = fit(stream, options);
    for (double& x : stream.reading_mm) x = -x;
    for (double& c : stream.c_rad) c += 0.5 * turn;
    const FitResult rear = fit(stream, options);
    ASSERT_EQ(rear.status, FitStatus::converged) << rear.message;
    for (std::size_t i = 0; i < front.parameters.size(); ++i) {
      const Estimate &a = front.parameters[i].estimate, &b = rear.parameters[i].estimate;
      EXPECT_NEAR(b.value, a.value, 10 * rounding_mm) << front.parameters[i].name;
      EXPECT_NEAR(b.u, a.u, 1e-9 * a.u) << front.parameters[i].name;
    }
  }
}

// Lengths below 1 mm are lengths as others.
TEST(SphereTorus, AreFoundHoweverSmall) {
  FitOptions options;
  options.surface = SurfaceKind::sphere;
  const FitResult ball = fit(sphere(0.6), options);
  ASSERT_EQ(ball.status, FitStatus::converged) << ball.message;
  EXPECT_NEAR(ball.parameter("radius").value, 0.6, 10 * rounding_mm);
  options.surface = SurfaceKind::torus;
  for (const bool inner : {false, true}) {
    const FitResult groove = fit(torus(30.0, 0.3, inner), options);
    ASSERT_EQ(groove.status, FitStatus::converged) << groove.message;
    EXPECT_NEAR(groove.parameter("minor_radius").value, 0.3, 100 * rounding_mm);
  }
}

// The line past the centre by a height is that through a sphere which is moved the other way.
// Central differences: h² of lengths of 0.6 mm at a depth of 0.3 mm or more.
TEST(Sphere, ItsInfluencesAreDifferencesOfItsPrediction) {
  for (const Root root : {Root::front, Root::rear}) {
    SurfaceFrame frame;
    frame.root = root;
    const auto surface = catalogue_entry(SurfaceKind::sphere).make(frame);
    const double c = 0.7, z = 31.8, h = 1e-5;
    const auto x_mm = [&](double dc, double dz, double height_mm) {
      const std::vector<double> cos_c(block_size, std::cos(c + dc)),
          sin_c(block_size, std::sin(c + dc)), position(block_size, z + dz), none(block_size);
      const double moved[] = {0.12 + height_mm * sin_c[0], -0.08 - height_mm * cos_c[0], 31.5, 0.6};
      PredictionBlock out;
      surface->evaluate(moved, {none.data(), cos_c.data(), sin_c.data(), position.data()}, out);
      EXPECT_TRUE(out.valid);
      return -out.residual[0];
    };
    const double at[] = {0.12, -0.08, 31.5, 0.6};
    const Surface::Influences found = surface->influences(at, c, z);
    EXPECT_NEAR(found.c, (x_mm(h, 0, 0) - x_mm(-h, 0, 0)) / (2 * h), 1e-8);
    EXPECT_NEAR(found.position, (x_mm(0, h, 0) - x_mm(0, -h, 0)) / (2 * h), 1e-8);
    EXPECT_NEAR(found.height, (x_mm(0, 0, h) - x_mm(0, 0, -h)) / (2 * h), 1e-8);
  }
}

/// Errors over u of 200 streams: their squares are χ² of 200 degrees of freedom, 1 in 10⁴ to
/// either side of [133, 285]. Readings are along the probe, as the model has their noise.
TEST(SphereTorus, UncertaintiesAreThoseOfTheNoise) {
  constexpr int streams = 200;
  constexpr double sigma_mm = 1e-3, low = 133.0, high = 285.0;
  std::mt19937_64 engine(1827);
  std::normal_distribution<double> normal(0.0, sigma_mm);
  for (const SurfaceKind surface : {SurfaceKind::sphere, SurfaceKind::torus}) {
    const bool is_sphere = surface == SurfaceKind::sphere;
    const ProbeStream exact = is_sphere ? sphere(25.0) : torus(30.0, 6.0, true);
    FitOptions options;
    options.surface = surface;
    options.noise_mm = sigma_mm;
    const FitResult truth = fit(exact, options);
    std::vector<double> squares(truth.parameters.size(), 0.0);
    for (int k = 0; k < streams; ++k) {
      ProbeStream noisy = exact;
      for (double& one : noisy.reading_mm) one += normal(engine);
      const FitResult found = fit(noisy, options);
      ASSERT_EQ(found.status, FitStatus::converged) << found.message;
      for (std::size_t p = 0; p < squares.size(); ++p) {
        const Estimate& e = found.parameters[p].estimate;
        squares[p] += std::pow((e.value - truth.parameters[p].estimate.value) / e.u, 2);
      }
    }
    for (std::size_t p = 0; p < squares.size(); ++p) {
      EXPECT_GT(squares[p], low) << truth.parameters[p].name;
      EXPECT_LT(squares[p], high) << truth.parameters[p].name;
    }
  }
}

// Tubes of half to twice the radius that touch each other in the middle of the section.
TEST(Torus, FurtherStartsGoThroughTheSameMiddle) {
  const auto surface = catalogue_entry(SurfaceKind::torus).make({});
  for (const double tube : {4.0, -4.0}) {
    const std::vector<double> level{0.1, -0.2, 0.0, 0.0, 31.0, 20.0, tube};
    std::vector<double> tubes;
    for (const std::vector<double>& one : surface->further_starts(level)) {
      EXPECT_NEAR(one[5] + one[6], 20.0 + tube, 1e-12);
      EXPECT_TRUE(std::equal(one.begin(), one.end() - 2, level.begin()));
      tubes.push_back(one[6] / tube);
    }
    const auto [least, most] = std::ranges::minmax(tubes);
    EXPECT_NEAR(least, 0.5, 1e-12);
    EXPECT_NEAR(most, 2.0, 1e-12);
  }
}

// Over one turn a tilt and another tube read nearly alike. No further start leads lower than the
// fit does, up to rounding.
TEST(Torus, OfOneTurnIsTheLowestOfItsStarts) {
  int gained = 0;
  for (int k = 0; k < 40; ++k) {
    const double lean = 2e-3 * (1 + k % 8), towards = turn * k / 40.0;
    const Vector3d d =
        Vector3d(lean * std::cos(towards), lean * std::sin(towards), 1.0).normalized();
    const Vector3d e = Vector3d(1.0, 0.0, -d.x() / d.z()).normalized(), f = d.cross(e);
    ProbeStream stream;
    for (int i = 0; i < 200; ++i) {
      const double share = i / 200.0, t = turn * share, along = 2.0 * share - 1.0;
      const double r = 30.0 + 5.0 * std::cos(along);
      probe(centre + r * (std::cos(t) * e + std::sin(t) * f) + 5.0 * std::sin(along) * d, stream);
    }
    const JointModel model(stream, place_set_ups(stream), catalogue_entry(SurfaceKind::torus), {});
    const std::vector<Sample> samples = samples_of(model);
    const auto rms_mm = [&](const Minimum& minimum) {
      return std::sqrt(minimum.normal.sum_rho / 200.0);
    };
    const std::vector<double> start = find_start(model, samples, Loss::plain);
    const double found_mm = rms_mm(lowest_minimum(model, samples, start, {}, 100).best);
    const Surface& surface = *model.parts().front().surface;
    const std::vector<double> level = surface.level_start(samples[0].view(), 200);
    const double first_mm = rms_mm(minimise(model, start, {}, 100));
    for (const std::vector<double>& other : surface.further_starts(level)) {
      const Minimum there = minimise(model, other, {}, 100);
      if (!there.converged) continue;
      EXPECT_LE(found_mm, rms_mm(there) + rounding_mm) << k;
      gained += rms_mm(there) + rounding_mm < first_mm;
    }
  }
  EXPECT_GT(gained, 0) << "the first start always leads there, too";
}

TEST(SphereTorus, AreFittedAndNotDiagnosedAndTakeNoGauge) {
  ProbeStream stream = sphere(25.0);
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::sphere;
  const Diagnosis diagnosis = diagnose(stream, options);
  EXPECT_TRUE(diagnosis.findings.empty());
  EXPECT_NE(diagnosis.noise.note.find("a sphere is fitted and not diagnosed"), std::string::npos);
  EXPECT_NO_THROW(fit(stream, options.fit));
  stream.setup.assign(stream.size(), 1), stream.setup.back() = 2;
  stream.setups.push_back({.number = 2});
  EXPECT_THROW(fit(stream, options.fit), InputError) << "a stream for each set-up";
  stream = sphere(25.0);
  stream.indication = Indication::relative;
  stream.nominal_radius_mm = 25.0;
  EXPECT_THROW(fit(stream, options.fit), InputError);
}

/// A ball larger than what it touches is refused, as for a cylinder.
TEST(Sphere, ABallThatIsTooLargeIsRefused) {
  FitOptions options;
  options.surface = SurfaceKind::sphere;
  options.ball_radius_mm = 30.0;
  const FitResult found = fit(sphere(25.0), options);
  EXPECT_EQ(found.status, FitStatus::implausible);
  EXPECT_NE(found.message.find("no part has a radius of -5"), std::string::npos) << found.message;
}

TEST(Sphere, ASphereFromAFileIsRefusedAsACylinder) {
  ProbeStream stream = sphere(25.0);
  stream.x_convention = XConvention{};
  FitOptions options;
  options.surface = surface_by_evidence(stream).surface;
  EXPECT_EQ(options.surface, SurfaceKind::cylinder);
  const FitResult result = fit(stream, options);
  EXPECT_EQ(result.status, FitStatus::implausible);
  EXPECT_NE(result.message.find("sphere of radius 25 mm"), std::string::npos) << result.message;
}

/// One section of a sphere: neither its height nor its radius is known.
TEST(Sphere, OneSectionIsNotEnough) {
  ProbeStream stream;
  for (int i = 0; i < 40; ++i) {
    const double t = turn * i / 40.0;
    probe(centre + 20.0 * Vector3d(std::cos(t), std::sin(t), 0.0), stream);
  }
  FitOptions options;
  options.surface = SurfaceKind::sphere;
  EXPECT_NE(fit(stream, options).status, FitStatus::converged);
}

}  // namespace
}  // namespace trueaxis
