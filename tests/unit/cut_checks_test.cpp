// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "job/beyond_probed.hpp"
#include "job/checks.hpp"
#include "job/files/job_words.hpp"
#include "job/material.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

using virtual_lathe::PartKind;

ProbeStream probed(PartKind kind, double x0_mm = 0.05) {
  virtual_lathe::Scenario scenario;
  scenario.seed = 7;
  scenario.part.kind = kind;
  scenario.part.radius_mm = 20.0, scenario.part.x0_mm = x0_mm;
  scenario.part.d_mm = 3.0;
  scenario.noise.sigma_mm = 5e-4;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = kind == PartKind::face ? 10.0 : 0.0, pass.end_mm = 40.0;
  pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = 24.3;
  scenario.plan.passes = {pass};
  return virtual_lathe::simulate(scenario);
}

Job job_of(const TargetSurface& target, SurfaceKind surface = SurfaceKind::cylinder) {
  Job job;
  job.references.resize(1);
  job.references[0].name = "seat";
  job.references[0].fit.surface = surface;
  job.target = target;
  job.tool.nose_radius_mm = 0.4;
  return job;
}

TargetSurface cylinder(double radius_mm, double z_start_mm, double z_end_mm) {
  return {TargetKind::cylinder, false, z_start_mm, z_end_mm, radius_mm, 0.0, 0.0, 0.0, 0.0};
}

/// What forbids the cut by its geometry, in words; empty: nothing does.
std::string cut_objection(const JobResult& result) {
  for (const JobCheck* check : {&surface_behind_ball, &material_between, &stock, &cut_too_far})
    if (const Reasons found = (*check)(result); !found.empty())
      return words_of(found.front(), result);
  return "";
}

Reasons cut_reservations(const JobResult& result) {
  Reasons all = cut_far(result);
  for (Reason& one : gauge_shows_no_radius(result)) all.push_back(std::move(one));
  return all;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// About its own axis the surface is as far above the target everywhere: 20 − 19.7 mm.
TEST(CutChecks, MaterialIsThatBetweenTheAxesOfPartAndTarget) {
  Job job = job_of(cylinder(19.7, 30.0, 10.0));
  job.stock_mm = 0.31;
  const JobResult result = run_job(job, {probed(PartKind::cylinder)});
  const auto over = material_over(result, 0);
  ASSERT_TRUE(over);
  EXPECT_NEAR(over->least.material_mm, 0.3, over->least.U_mm + 1e-4);
  EXPECT_NEAR(over->most.material_mm, 0.3, over->most.U_mm + 1e-4);
  EXPECT_EQ(cut_objection(result), "");
  EXPECT_TRUE(cut_reservations(result).empty());
  EXPECT_TRUE(result.verdict.go()) << verdict_line(result);
}

// An axis 50 µm off another: 50 µm more at one side and less at the other.
TEST(CutChecks, EccentricityCountsWhereTheTargetIsAboutAnotherAxis) {
  Job job = job_of(cylinder(19.9, 30.0, 10.0));
  job.references.push_back(job.references[0]);
  job.references[0].name = "far", job.references[0].weight = 1e6;
  job.stock_mm = 0.14;
  const JobResult result =
      run_job(job, {probed(PartKind::cylinder, 0.12), probed(PartKind::cylinder, 0.07)});
  const auto over = material_over(result, 1);
  ASSERT_TRUE(over);
  EXPECT_NEAR(over->least.material_mm, 0.05, 2e-3);
  EXPECT_NEAR(over->most.material_mm, 0.15, 2e-3);
  EXPECT_NEAR(over->most.c_rad, 3.1416, 0.1);
  EXPECT_TRUE(says(cut_objection(result), "more than the stated stock of 140 µm"))
      << cut_objection(result);
}

TEST(CutChecks, TheStockIsAskedForOnTheProbedLengthOnly) {
  EXPECT_THROW(run_job(job_of(cylinder(19.7, 30.0, 10.0)), {probed(PartKind::cylinder)}),
               InputError);
  EXPECT_NO_THROW(run_job(job_of(cylinder(19.7, 60.0, 50.0)), {probed(PartKind::cylinder)}));
}

// The plane is at 3 mm.
TEST(CutChecks, OfAFaceTheMaterialLiesAlongZ) {
  for (const double z_mm : {2.8, 3.1}) {
    TargetSurface face;
    face.kind = TargetKind::face;
    face.z_face_mm = face.z_start_mm = face.z_end_mm = z_mm;
    face.radius_start_mm = 38.0, face.radius_end_mm = 20.0;
    Job job = job_of(face, SurfaceKind::plane);
    EXPECT_THROW(run_job(job, {probed(PartKind::face)}), InputError);
    job.stock_mm = 0.25;
    const JobResult result = run_job(job, {probed(PartKind::face)});
    const auto over = material_over(result, 0);
    ASSERT_TRUE(over);
    EXPECT_NEAR(over->least.material_mm, 3.0 - z_mm, 1e-3);
    EXPECT_EQ(cut_objection(result).empty(), z_mm < 3.0) << cut_objection(result);
  }
}

// A face is there at X as at −X: whichever the probe reads, the same material is above the target.
TEST(CutChecks, AFaceProbedFromTheRearHasItsMaterial) {
  TargetSurface face;
  face.kind = TargetKind::face;
  face.z_face_mm = face.z_start_mm = face.z_end_mm = -20.0;
  face.radius_start_mm = 38.0, face.radius_end_mm = 20.0;
  Job job = job_of(face, SurfaceKind::plane);
  ProbeStream rear = probed(PartKind::face);
  for (double& x : rear.position_mm) x = -x;
  for (double& c : rear.c_rad) c += pi;  // the same places of the part
  EXPECT_THROW(run_job(job, {rear}), InputError);
  job.stock_mm = 0.25;
  const JobResult result = run_job(job, {rear});
  const auto over = material_over(result, 0);
  ASSERT_TRUE(over);
  EXPECT_NEAR(over->most.material_mm, 3.0 + 20.0, 1e-3);
  EXPECT_TRUE(says(cut_objection(result), "more than the stated stock of 250 µm"))
      << cut_objection(result);
}

// u of the axis grows as √(1 + 12 d²/L²) with the distance d from the middle of the length L.
TEST(CutChecks, TheFactorOfUIsThatOfALine) {
  for (const auto& [z_mm, sentences] : {std::pair{90.0, 0u}, std::pair{150.0, 1u}}) {
    const JobResult result =
        run_job(job_of(cylinder(18.0, z_mm, z_mm - 10.0)), {probed(PartKind::cylinder)});
    const double d = z_mm - 20.0, factor = std::sqrt(1.0 + 12.0 * d * d / 1600.0);
    EXPECT_NEAR(u_beyond_probed(result, 0), factor, 0.03 * factor);
    EXPECT_EQ(cut_reservations(result).size(), sentences);
    EXPECT_EQ(cut_objection(result), "");
  }
  const JobResult far = run_job(job_of(cylinder(18.0, 500.0, 490.0)), {probed(PartKind::cylinder)});
  EXPECT_TRUE(says(cut_objection(far), "that U is extrapolated to 4")) << cut_objection(far);
}

TEST(CutChecks, OfARelativeGaugeTheMaterialIsNotKnownAndThatIsSaid) {
  ProbeStream stream = probed(PartKind::cylinder);
  for (double& x : stream.reading_mm) x -= 20.0;
  stream.indication = Indication::relative;
  stream.nominal_radius_mm = 20.0;
  const JobResult result = run_job(job_of(cylinder(19.7, 30.0, 10.0)), {stream});
  EXPECT_EQ(cut_objection(result), "");
  ASSERT_EQ(cut_reservations(result).size(), 1u);
  EXPECT_EQ(cut_reservations(result)[0].code, ReasonCode::gauge_shows_no_radius);
}

}  // namespace
}  // namespace trueaxis
