// SPDX-License-Identifier: Apache-2.0
// GO means go: streams that once got a GO and were cut 13 to 40 µm off, and what is said instead.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "diagnose/files/seen.hpp"
#include "job/doubts.hpp"
#include "job/files/job_words.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

using virtual_lathe::Scenario;

/// A cylinder of R 25 in one pass of 40 turns at 60 rpm, σ 1 µm.
Scenario cylinder(std::uint64_t seed) {
  Scenario s;
  s.part.radius_mm = 25.0;
  s.part.x0_mm = 0.03, s.part.y0_mm = -0.02, s.part.l = 2e-4, s.part.m = 1e-4;
  s.noise.sigma_mm = 1e-3;
  virtual_lathe::PlannedPass pass;
  pass.end_mm = 40.0, pass.feed_mm_per_rev = 1.0;
  pass.readings_per_revolution = 36.7, pass.jitter = 0.2;
  s.plan.passes.push_back(pass);
  s.seed = seed;
  return s;
}

Job job_of(const Scenario& s, double tolerance_um) {
  Job job;
  job.references.resize(1);
  job.references[0].name = "seat";
  job.references[0].fit.surface =
      s.part.kind == virtual_lathe::PartKind::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
  // The probe is set and calibrated: what one pass does not show of it leaves nothing open.
  job.references[0].fit.influences = {{Influence::Kind::probe_height, 0.0},
                                      {Influence::Kind::probe_gain, 0.0}};
  job.target = TargetSurface{.z_start_mm = 60.0, .z_end_mm = 45.0, .radius_mm = 20.0};
  job.coaxiality_tolerance_mm = 1e-3 * tolerance_um;
  job.tool.feed_mm_per_rev = 1.0;
  job.tool.interpolation = Interpolation::linear;
  job.values_of_form = false;
  return job;
}

JobResult decided(const Scenario& s, double tolerance_um = 10.0) {
  return run_job(job_of(s, tolerance_um), {virtual_lathe::simulate(s)});
}

ProbeStream without_clock(ProbeStream stream) {
  stream.time_s.clear();
  stream.spindle_rpm.reset();
  return stream;
}

TEST(Verdict, ASlipWithoutAClockIsNamedByTheReading) {
  for (const double slip_mm : {0.02, 0.03}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      Scenario s = cylinder(seed);
      const double at = static_cast<double>(seed);
      s.effects.push_back({"part.slip",
                           {{"dx_mm", slip_mm * std::cos(at)},
                            {"dy_mm", slip_mm * std::sin(at)},
                            {"turn_rad", 0.0},
                            {"time_s", 20.0}}});
      const JobResult result =
          run_job(job_of(s, 10.0), {without_clock(virtual_lathe::simulate(s))});
      EXPECT_NE(verdict_line(result).find("the part slipped in the chuck at reading "),
                std::string::npos)
          << verdict_line(result);
      ASSERT_NE(result.diagnoses[0]->slip(), nullptr);
      EXPECT_EQ(seen_text(*result.diagnoses[0]->slip(), 2.0).find("the part moved at reading "),
                0u);
      // Half of 40 turns of 36.7: a few readings either way show no step.
      EXPECT_NEAR(result.diagnoses[0]->slip()->parameter("onset").value, 734.0, 10.0);
    }
  }
}

// What creeps may creep on: the table waits. The axis is that at the end, with its u.
TEST(Verdict, ASlipThatLastsIsNamedByItsTimesAndRefused) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Scenario s = cylinder(seed);
    s.effects.push_back(
        {"part.slip", {{"dx_mm", 0.03}, {"dy_mm", -0.01}, {"time_s", 15.0}, {"duration_s", 6.0}}});
    const JobResult result = decided(s);
    EXPECT_EQ(result.verdict.decision, Decision::no_go) << verdict_line(result);
    EXPECT_NE(verdict_line(result).find("the part slipped in the chuck from "), std::string::npos)
        << verdict_line(result);
    ASSERT_NE(result.diagnoses[0]->slip(), nullptr);
    const Finding& slip = *result.diagnoses[0]->slip();
    // 4 u: a probability of 6e-5 in each of the 16.
    const Estimate onset = slip.parameter("onset"), duration = slip.parameter("duration");
    EXPECT_NEAR(onset.value, 15.0, 4.0 * onset.u) << seed;
    EXPECT_NEAR(duration.value, 6.0, 4.0 * duration.u) << seed;
    EXPECT_LT(duration.u, 0.5);
    EXPECT_EQ(next_measurement(result), nullptr) << "it is clamped again first";
    const AxisEstimate& axis = result.diagnoses[0]->extended.axis;
    const double n = std::sqrt(1.0 - s.part.l * s.part.l - s.part.m * s.part.m);
    const auto at = axis.axis.at(40.0);
    EXPECT_NEAR(at[0], s.part.x0_mm + 0.03 + s.part.l / n * 40.0, 4.0 * axis.u_at(40.0)) << seed;
    EXPECT_NEAR(at[1], s.part.y0_mm - 0.01 + s.part.m / n * 40.0, 4.0 * axis.u_at(40.0)) << seed;
  }
}

// No smooth form follows a step of 20 σ two turns before the end. The readings beyond it do not
// count as outliers for that, and date it to two intervals between them.
TEST(Verdict, ASlipNearTheEndIsDatedAndNotExcluded) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Scenario s = cylinder(seed);
    s.effects.push_back({"part.slip", {{"dx_mm", 0.02}, {"dy_mm", 0.0}, {"time_s", 38.0}}});
    const JobResult result = decided(s);
    EXPECT_TRUE(result.diagnoses[0]->noise.masked.empty()) << seed;
    ASSERT_NE(result.diagnoses[0]->slip(), nullptr) << seed;
    EXPECT_NEAR(result.diagnoses[0]->slip()->term.shape.onset_s, 38.0, 2.0 / 36.7) << seed;
  }
}

// Where the part was before, and the step.
TEST(Verdict, AfterASlipTheAxisIsThatOfThePartAsItNowStands) {
  for (const std::uint64_t seed : {4, 5, 6, 7}) {
    Scenario s = cylinder(seed);
    s.effects.push_back(
        {"part.slip", {{"dx_mm", 0.03}, {"dy_mm", 0.0}, {"turn_rad", 0.0}, {"time_s", 20.0}}});
    const JobResult result = decided(s);
    EXPECT_EQ(result.verdict.decision, Decision::go) << verdict_line(result);
    ASSERT_TRUE(result.target_axis.has_value());
    const AxisEstimate& axis = result.diagnoses[0]->extended.axis;
    for (const double z : {0.0, 40.0}) {
      const auto at = axis.axis.at(z);
      const double n = std::sqrt(1.0 - s.part.l * s.part.l - s.part.m * s.part.m);
      // 4.5 standard uncertainties: a probability of 1e-5 in each of the 16.
      EXPECT_NEAR(at[0], s.part.x0_mm + 0.03 + s.part.l / n * z, 4.5 * axis.u_at(z)) << seed;
      EXPECT_NEAR(at[1], s.part.y0_mm + s.part.m / n * z, 4.5 * axis.u_at(z)) << seed;
    }
  }
}

TEST(Verdict, AfterTwoSlipsThereIsNoNumberOfAnAxis) {
  Scenario s = cylinder(4);
  s.effects.push_back(
      {"part.slip", {{"dx_mm", 0.03}, {"dy_mm", 0.0}, {"turn_rad", 0.0}, {"time_s", 12.0}}});
  s.effects.push_back(
      {"part.slip", {{"dx_mm", -0.02}, {"dy_mm", 0.03}, {"turn_rad", 0.0}, {"time_s", 27.0}}});
  const JobResult result = decided(s);
  EXPECT_FALSE(result.target_axis.has_value());
  EXPECT_FALSE(result.correction.has_value());
  for (const char* name : {"x0", "y0", "l", "m", "tilt"}) {
    EXPECT_FALSE(result.fits[0].parameter(name).determined()) << name;
    EXPECT_FALSE(result.fits[0].parameter(name).why_not.empty()) << name;
  }
  EXPECT_TRUE(result.fits[0].parameter("radius").determined());
}

// 1.013 Hz under 60 rpm beats half a cycle over the stream: the axis takes the vibration in.
TEST(Verdict, AVibrationThatBeatsWithTheSpindleIsNotProven) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Scenario s = cylinder(seed);
    s.effects.push_back({"environment.vibration",
                         {{"frequency_hz", 1.013},
                          {"amplitude_mm", 0.005},
                          {"phase_rad", 1.1 * static_cast<double>(seed)}}});
    const JobResult result = decided(s);
    EXPECT_FALSE(result.verdict.go()) << seed << ": " << verdict_line(result);
  }
}

TEST(Verdict, AStrongAsynchronousMotionIsNoNoise) {
  for (const double amplitude_mm : {0.002, 0.005, 0.01}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      Scenario s = cylinder(seed);
      s.effects.push_back({"spindle.asynchronous",
                           {{"order", 0.43},
                            {"amplitude_mm", amplitude_mm},
                            {"phase_rad", static_cast<double>(seed)}}});
      const JobResult result = decided(s);
      ASSERT_EQ(result.diagnoses[0]->findings.size(), 1u) << amplitude_mm << ' ' << seed;
      EXPECT_TRUE(result.diagnoses[0]->findings[0].may_be("spindle.asynchronous"));
      // σ of 1469 readings is known to 1/√(2 N): five of these.
      EXPECT_NEAR(result.diagnoses[0]->noise.sigma_mm, 1e-3, 5.0 * 1e-3 / std::sqrt(2.0 * 1469));
    }
  }
}

TEST(Verdict, AConeNearlyToItsApexIsDiagnosed) {
  for (const double small_radius_mm : {1.0, 0.3}) {
    Scenario s = cylinder(1);
    s.part.kind = virtual_lathe::PartKind::cone;
    s.part.half_angle_rad = std::numbers::pi / 6.0;  // a centre of 60°
    s.part.radius_mm = small_radius_mm;
    s.plan.passes[0].end_mm = 15.6;
    s.plan.passes[0].feed_mm_per_rev = 0.5;
    const JobResult result = decided(s);
    EXPECT_EQ(result.diagnoses[0]->verdict, DiagnosisVerdict::ideal);
    const Estimate& x0 = result.fits[0].parameter("x0");
    EXPECT_NEAR(x0.value, s.part.x0_mm, 5.0 * x0.u);
  }
}

/// As far back at another speed, by which a delay shows.
void add_way_back(Scenario& s) {
  virtual_lathe::PlannedPass back = s.plan.passes[0];
  std::swap(back.start_mm, back.end_mm);
  back.speed_rpm *= 2.5;
  s.plan.passes.push_back(back);
}

/// What no number of readings of one pass shows, the line names with the pass that does.
TEST(Verdict, WhatOnePassDoesNotShowIsNamed) {
  Scenario s = cylinder(11);
  const double upper_um = 1e3 * decided(s, 1e3).verdict.upper_mm;
  // A tolerance that what is hidden exceeds without any noise.
  const JobResult open = decided(s, 0.3 * upper_um);
  ASSERT_EQ(open.verdict.decision, Decision::not_proven) << verdict_line(open);
  const Reasons would = open.verdict.what_would_prove();
  ASSERT_EQ(would.size(), 1u);
  EXPECT_EQ(would.front().code, ReasonCode::hidden_cause);
  const std::string says = words_of(would.front(), open);
  EXPECT_NE(says.find("probe.la"), std::string::npos) << says;  // latency or lag
  EXPECT_NE(says.find("probe back at"), std::string::npos) << says;
  add_way_back(s);
  EXPECT_LT(1e3 * decided(s, 1e3).verdict.upper_mm, 0.9 * upper_um);
}

/// The readings that the line asks for prove it.
TEST(Verdict, WhatWouldProveItDoes) {
  Scenario s = cylinder(11);
  add_way_back(s);
  const double upper_um = 1e3 * decided(s, 1e3).verdict.upper_mm;
  // A tolerance that what is hidden exceeds without any noise.
  const JobResult open = decided(s, 0.3 * upper_um);
  ASSERT_EQ(open.verdict.decision, Decision::not_proven) << verdict_line(open);
  const Reasons would = open.verdict.what_would_prove();
  ASSERT_EQ(would.size(), 1u);
  ASSERT_FALSE(would.front().parts.empty()) << words_of(would.front(), open);
  ASSERT_EQ(would.front().parts.front().code, ReasonCode::more_readings);
  const double readings = would.front().parts.front().number("needed")->value;
  // Less than u shrinks with n, the following error of the actuator does not.
  EXPECT_GT(readings, 2.0 * 1469.0 / (0.6 * 0.6));
  for (auto& pass : s.plan.passes) pass.readings_per_revolution *= readings / (2.0 * 1469.0);
  EXPECT_EQ(decided(s, 0.6 * upper_um).verdict.decision, Decision::go)
      << verdict_line(decided(s, 0.6 * upper_um));
}

TEST(Verdict, OutOfToleranceBeyondDoubtIsNoGo) {
  Scenario s = cylinder(12), other = cylinder(13);
  other.part.x0_mm += 0.05;  // two seats 50 µm apart: the compromise leaves 50 µm of diameter
  other.plan.passes[0].start_mm = 70.0, other.plan.passes[0].end_mm = 110.0;
  Job job = job_of(s, 10.0);
  job.references.push_back(job.references[0]);
  const JobResult result =
      run_job(job, {virtual_lathe::simulate(s), virtual_lathe::simulate(other)});
  EXPECT_EQ(result.verdict.decision, Decision::no_go) << verdict_line(result);
  EXPECT_GT(result.verdict.lower_mm, 0.04);
}

TEST(Verdict, AnAxisThatTheDiagnosisMovedIsNoPlainGoWhileTheCauseIsOpen) {
  Scenario s = cylinder(1);
  s.effects.push_back(
      {"spindle.asynchronous", {{"order", 0.43}, {"amplitude_mm", 0.02}, {"phase_rad", 1.0}}});
  const JobResult result = decided(s);
  ASSERT_FALSE(result.diagnoses[0]->findings.at(0).rivals.empty());
  EXPECT_EQ(result.verdict.decision, Decision::go_with_reservations) << verdict_line(result);
  EXPECT_EQ(verdict_line(result).rfind("GO with reservations: ", 0), 0u);
  EXPECT_EQ(result.verdict.reservations.size(), 1u);
  // Were the axis where the ideal fit has it, a tighter tolerance would not be kept.
  const double tolerance_um = 1.01e3 * result.verdict.upper_mm;
  EXPECT_EQ(decided(s, tolerance_um).verdict.decision, Decision::not_proven);
}

}  // namespace
}  // namespace trueaxis
