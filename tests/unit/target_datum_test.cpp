// SPDX-License-Identifier: Apache-2.0
// Datum systems of ISO 5459: the target axis against least squares of the points themselves, and
// against geometry.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "support/dense.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

constexpr double noise_mm = 1e-5;

struct Stands {
  double x0_mm, y0_mm, l, m;
};

ProbeStream seat(double radius_mm, double z_mm, const Stands& at, std::uint64_t seed,
                 double readings_per_turn = 36.0) {
  virtual_lathe::Scenario scenario;
  scenario.seed = seed;
  scenario.part.kind = virtual_lathe::PartKind::cylinder;
  scenario.part.radius_mm = radius_mm;
  scenario.part.x0_mm = at.x0_mm, scenario.part.y0_mm = at.y0_mm;
  scenario.part.l = at.l, scenario.part.m = at.m;
  scenario.noise.sigma_mm = noise_mm;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = z_mm, pass.end_mm = z_mm + 12.0;
  pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = readings_per_turn;
  scenario.plan.passes = {pass};
  return virtual_lathe::simulate(scenario);
}

ProbeStream shoulder(double l, double m) {
  virtual_lathe::Scenario scenario;
  scenario.seed = 3;
  scenario.part.kind = virtual_lathe::PartKind::face;
  scenario.part.d_mm = -1.0, scenario.part.l = l, scenario.part.m = m;
  scenario.noise.sigma_mm = noise_mm;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = 10.0, pass.end_mm = 40.0;
  pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = 36.0;
  scenario.plan.passes = {pass};
  return virtual_lathe::simulate(scenario);
}

Job job_of(const std::vector<std::pair<std::string, SurfaceKind>>& references) {
  Job job;
  for (const auto& [name, surface] : references) {
    JobReference& one = job.references.emplace_back();
    one.name = name;
    one.fit.surface = surface;
  }
  job.target = TargetSurface{TargetKind::cylinder, false, 60.0, 40.0, 19.0, 0.0, 0.0, 0.0, 0.0};
  job.tool.nose_radius_mm = 0.4;
  job.coaxiality_tolerance_mm = 0.05;
  job.values_of_form = false;
  return job;
}

/// Distances of the readings from a line (x, y at Z = 0, slopes) less a radius each stream, whose
/// squares are summed, each stream as one. Newton's method with differences: no formula of ours.
Eigen::Vector4d least_squares_of(const std::vector<ProbeStream>& streams) {
  const auto streams_n = static_cast<Eigen::Index>(streams.size());
  Eigen::VectorXd p = Eigen::VectorXd::Zero(4 + streams_n);
  for (Eigen::Index s = 0; s < streams_n; ++s) p[4 + s] = 20.0;
  const auto residuals = [&](const Eigen::VectorXd& q) {
    std::vector<double> out;
    for (std::size_t s = 0; s < streams.size(); ++s)
      for (std::size_t i = 0; i < streams[s].size(); ++i) {
        const double x = streams[s].reading_mm[i], c = streams[s].c_rad[i];
        const Eigen::Vector3d point(x * std::cos(c), x * std::sin(c), streams[s].position_mm[i]);
        const Eigen::Vector3d along = Eigen::Vector3d(q[2], q[3], 1.0).normalized();
        const double off = (point - Eigen::Vector3d(q[0], q[1], 0.0)).cross(along).norm();
        out.push_back((off - q[4 + static_cast<Eigen::Index>(s)]) /
                      std::sqrt(static_cast<double>(streams[s].size())));
      }
    return Eigen::VectorXd(
        Eigen::Map<Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size())));
  };
  for (int step = 0; step < 20; ++step) {
    const Eigen::VectorXd now = residuals(p);
    Eigen::MatrixXd slope(now.size(), p.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      const double by = k == 2 || k == 3 ? 1e-6 : 1e-4;
      Eigen::VectorXd more = p, less = p;
      more[k] += by;
      less[k] -= by;
      slope.col(k) = (residuals(more) - residuals(less)) / (2.0 * by);
    }
    p -= dense::least_squares(slope, now);
  }
  return p.head<4>();
}

/// Two seats that are not quite coaxial. The tilt of each alone, over the 100 mm between them, is
/// far off; the weighted compromise takes both. The common axis is that of the points. Readings
/// along the probe line and distances differ by (e/R)² of the residuals, 4e-6 of 10 µm.
TEST(TargetDatum, ACommonDatumIsLeastSquaresOfBothSeats) {
  const std::vector<ProbeStream> streams{seat(20.0, 0.0, {0.02, -0.01, 2e-4, 1e-4}, 1),
                                         seat(24.0, 100.0, {0.06, 0.01, -3e-4, 2e-4}, 2)};
  Job job = job_of({{"A", SurfaceKind::cylinder}, {"B", SurfaceKind::cylinder}});
  job.datums = {{"A", "B"}};
  job.coaxiality_tolerance_mm = 0.2;  // what the seats themselves are off it, over the cut, is 0.1
  const JobResult result = run_job(job, streams);
  ASSERT_TRUE(result.target_axis) << verdict_line(result);
  const Eigen::Vector4d own = least_squares_of(streams);
  for (const double z : {0.0, 50.0, 112.0}) {
    const auto [x, y] = result.target_axis->axis.axis.at(z);
    EXPECT_NEAR(x, own[0] + own[2] * z, 2e-6) << z;
    EXPECT_NEAR(y, own[1] + own[3] * z, 2e-6) << z;
  }
  ASSERT_EQ(result.target_axis->remainders.size(), 1U);
  EXPECT_EQ(result.target_axis->remainders[0].name, "A-B");
  EXPECT_LT(result.target_axis->remainders[0].coaxiality_mm, 1e-12);
  EXPECT_EQ(result.datum->references.size(), 2U);
  EXPECT_GT(result.datum->references[0].coaxiality_mm, 1e-3) << "what the seat itself is off";
  EXPECT_EQ(result.verdict.decision, Decision::go) << verdict_line(result);
}

/// A seat in the middle that is off the line of the two others counts the same however
/// densely it was probed: by twice the readings the axis would move by a micrometre.
TEST(TargetDatum, ASeatCountsByItsWeightNotByItsReadings) {
  const ProbeStream low = seat(20.0, 0.0, {0.02, -0.01, 0.0, 0.0}, 1);
  const ProbeStream high = seat(24.0, 100.0, {0.02, -0.01, 0.0, 0.0}, 2);
  const Stands beside{0.035, -0.01, 0.0, 0.0};
  Job job = job_of(
      {{"A", SurfaceKind::cylinder}, {"B", SurfaceKind::cylinder}, {"M", SurfaceKind::cylinder}});
  job.target->z_start_mm = 85.0, job.target->z_end_mm = 75.0;
  job.datums = {{"A", "B", "M"}};
  const auto at = [&](const ProbeStream& middle) {
    const JobResult result = run_job(job, {low, high, middle});
    return result.target_axis->axis.axis.at(56.0)[0];
  };
  const double once = at(seat(22.0, 50.0, beside, 3));
  EXPECT_NEAR(at(seat(22.0, 50.0, beside, 4, 72.0)), once, 1e-5);
  job.references[2].weight = 2.0;
  EXPECT_GT(at(seat(22.0, 50.0, beside, 3)), once + 1e-3);
}

/// Direction of the shoulder; at the middle of the seat, where a tilt shifts nothing, its place.
TEST(TargetDatum, AFaceFirstGivesTheDirection) {
  const Stands stands{0.03, -0.02, 4e-4, -2e-4};
  Job job = job_of({{"A", SurfaceKind::cylinder}, {"C", SurfaceKind::plane}});
  job.datums = {{"C"}, {"A"}};
  const JobResult result = run_job(job, {seat(20.0, 0.0, stands, 5), shoulder(-1e-4, 3e-4)});
  ASSERT_TRUE(result.target_axis) << verdict_line(result);
  const Axis& axis = result.target_axis->axis.axis;
  const double u_slope =
      std::sqrt(result.target_axis->axis.covariance(AxisRow::slope_x, AxisRow::slope_x));
  EXPECT_LT(u_slope, 2e-5) << "else the seat's own direction, 5e-4 elsewhere, would pass";
  EXPECT_NEAR(axis.slope_x, -1e-4, 5.0 * u_slope);
  EXPECT_NEAR(axis.slope_y, 3e-4, 5.0 * u_slope);
  const double z = 6.0, u = result.target_axis->axis.u_at(z);
  EXPECT_LT(u, 1e-3);  // of the probe's height and gain, as typical
  const auto [x, y] = axis.at(z);
  EXPECT_NEAR(x, stands.x0_mm + stands.l * z, 5.0 * u);
  EXPECT_NEAR(y, stands.y0_mm + stands.m * z, 5.0 * u);
  EXPECT_EQ(result.datum->name, "C | A");
}

/// A rise h(1 + cos πφ/w)/2 over ± w draws the circumscribed axis by h/2: the circle touches it on
/// top and the part across. Least squares goes by 2/n Σ h cos φ.
TEST(TargetDatum, TheAssociationOfAReferenceMovesTheCut) {
  constexpr double height_mm = 4e-3, wide_rad = 0.8;
  ProbeStream stream = seat(20.0, 0.0, {0.0, 0.0, 0.0, 0.0}, 9);
  double least_squares_mm = 0.0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double phi = std::remainder(stream.c_rad[i], 2.0 * std::numbers::pi);
    if (std::abs(phi) > wide_rad) continue;
    const double rise = 0.5 * height_mm * (1.0 + std::cos(std::numbers::pi * phi / wide_rad));
    stream.reading_mm[i] += rise;
    least_squares_mm += 2.0 * rise * std::cos(phi) / static_cast<double>(stream.size());
  }
  Job job = job_of({{"A", SurfaceKind::cylinder}});
  const JobResult plain = run_job(job, {stream});
  job.references[0].association = Criterion::minimum_circumscribed;
  const JobResult result = run_job(job, {stream});
  ASSERT_TRUE(result.target_axis && plain.target_axis) << verdict_line(result);
  for (const double z : {1.0, 11.0}) {
    const double by =
        result.target_axis->axis.axis.at(z)[0] - plain.target_axis->axis.axis.at(z)[0];
    // Noise of 0.01 µm in what touches, and the place of the nearest reading, h(π/w · 5°)²/4.
    EXPECT_NEAR(by, 0.5 * height_mm - least_squares_mm, 2e-4) << z;
    EXPECT_GT(result.target_axis->axis.u_at(z), plain.target_axis->axis.u_at(z));
  }
}

bool says(const JobResult& result, const std::string& part) {
  return verdict_line(result).find(part) != std::string::npos;
}

/// A seat that was probed in another clamping is elsewhere: nothing shows it but the other
/// seat.
TEST(TargetDatum, SeatsThatShareNoAxisAreNoDatum) {
  const Stands at{0.02, -0.01, 2e-4, 1e-4}, elsewhere{0.12, 0.08, -6e-4, 2e-4};
  const std::vector<ProbeStream> streams{seat(20.0, 0.0, at, 1), seat(24.0, 100.0, elsewhere, 2)};
  Job job = job_of({{"A", SurfaceKind::cylinder}, {"B", SurfaceKind::cylinder}});
  job.datums = {{"A", "B"}};
  const JobResult common = run_job(job, streams);
  EXPECT_EQ(common.verdict.decision, Decision::not_proven);
  EXPECT_TRUE(says(common, "do not share one axis")) << verdict_line(common);
  job.datums = {{"A"}};
  const JobResult alone = run_job(job, streams);
  EXPECT_EQ(alone.verdict.decision, Decision::go_with_reservations);
  EXPECT_TRUE(says(alone, "off the datum A")) << verdict_line(alone);
}

/// A face and the axis after it are two datums, and need not be square: 6e-4 over the cut's 54 mm
/// from the seat's middle is 69 µm in diameter. Two seats after a face share one axis all the same.
TEST(TargetDatum, AFaceNeedNotBeSquareToTheAxisAfterIt) {
  const Stands at{0.03, -0.02, 4e-4, -2e-4}, elsewhere{0.12, 0.08, -6e-4, 2e-4};
  const ProbeStream a = seat(20.0, 0.0, at, 5), face = shoulder(-1e-4, 3e-4);
  Job job = job_of({{"A", SurfaceKind::cylinder}, {"C", SurfaceKind::plane}});
  job.coaxiality_tolerance_mm = 0.03;
  job.datums = {{"C"}, {"A"}};
  const JobResult one = run_job(job, {a, face});
  EXPECT_EQ(one.verdict.decision, Decision::go) << verdict_line(one);
  job = job_of(
      {{"A", SurfaceKind::cylinder}, {"B", SurfaceKind::cylinder}, {"C", SurfaceKind::plane}});
  job.coaxiality_tolerance_mm = 0.05;
  job.datums = {{"C"}, {"A", "B"}};
  const Stands near{0.04, -0.02, 3e-4, -1e-4};
  const JobResult two = run_job(job, {a, seat(24.0, 100.0, near, 6), face});
  EXPECT_EQ(two.verdict.decision, Decision::go) << verdict_line(two);
  const JobResult apart = run_job(job, {a, seat(24.0, 100.0, elsewhere, 6), face});
  EXPECT_TRUE(says(apart, "off the datum A-B")) << verdict_line(apart);
}

/// A slip while B is probed leaves A where the part was before.
TEST(TargetDatum, ASlipLeavesTheOtherReferencesBehind) {
  const Stands at{0.02, -0.01, 0.0, 0.0};
  virtual_lathe::Scenario scenario;
  scenario.seed = 4;
  scenario.part.kind = virtual_lathe::PartKind::cylinder;
  scenario.part.radius_mm = 24.0, scenario.part.x0_mm = at.x0_mm, scenario.part.y0_mm = at.y0_mm;
  scenario.noise.sigma_mm = 5e-4;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = 100.0, pass.end_mm = 130.0;
  pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = 36.3;
  scenario.plan.passes = {pass};
  const ProbeStream still = virtual_lathe::simulate(scenario);
  scenario.effects = {{"part.slip", {{"dx_mm", 0.02}, {"time_s", 0.5 * still.time_s.back()}}}};
  Job job = job_of({{"A", SurfaceKind::cylinder}, {"B", SurfaceKind::cylinder}});
  job.datums = {{"A"}};
  const JobResult result =
      run_job(job, {seat(20.0, 0.0, at, 1), virtual_lathe::simulate(scenario)});
  EXPECT_FALSE(result.verdict.go()) << verdict_line(result);
  EXPECT_TRUE(says(result, "slipped while B was probed")) << verdict_line(result);
}

std::string refusal_of(const std::string& reference, const std::string& target) {
  try {
    read_job_toml("[[reference]]\nname = \"A\"\nstream = \"a.csv\"\nsurface = \"cylinder\"\n" +
                      reference +
                      "\n[[reference]]\nname = \"C\"\nstream = \"c.csv\"\nsurface = \"plane\"\n"
                      "[target]\nsurface = \"cylinder\"\nz_start_mm = 60\nz_end_mm = 40\n"
                      "radius_mm = 19\n" +
                      target + "\n[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = 0.1\n",
                  "job.toml");
  } catch (const InputError& error) {
    return error.diagnostics().front().message;
  }
  return "";
}

TEST(TargetDatum, WhatMakesNoDatumIsRefusedWithWhatToDo) {
  const auto expect = [](const std::string& reference, const std::string& target,
                         const std::string& part) {
    const std::string said = refusal_of(reference, target);
    EXPECT_NE(said.find(part), std::string::npos) << target << ": " << said;
  };
  EXPECT_EQ(refusal_of("", "datum = [\"A\"]\nsecondary_datum = [\"C\"]"), "");
  EXPECT_EQ(refusal_of("association = \"minimum_circumscribed\"", "datum = [\"A\"]"), "");
  expect("", "datum = [\"B\"]", "names 'B', which is not a reference of this job: those are A, C");
  expect("", "datum = [\"C\"]", "name a cylinder or cone as `secondary_datum`");
  expect("", "datum = [\"A\", \"C\"]", "names a face together with another reference");
  expect("", "datum = [\"A\"]\nsecondary_datum = [\"A\"]",
         "is an axis, but the primary datum already fixes the axis");
  expect("", "secondary_datum = [\"C\"]", "needs a primary datum");
  expect("association = \"maximum_inscribed\"", "", "applies to a bore");
  expect("association = \"circumscribed\"", "", "minimum_circumscribed");
}

}  // namespace
}  // namespace trueaxis
