// SPDX-License-Identifier: Apache-2.0
// Which findings a correction may follow, and what the tool then does.
#include "job/inclusion.hpp"

#include <gtest/gtest.h>

#include <string_view>

#include "correct/profile.hpp"
#include "format/reason_words.hpp"
#include "support/diagnosis_example.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

Finding spindle_lobes() {
  Finding finding = example::lobes();
  finding.term.effect = find_effect("spindle.radial_synchronous");
  finding.rivals.clear();
  finding.term.linear.resize(2);
  return finding;
}

JobResult asked(const Finding& finding) {
  JobResult result = example::diagnosed_job(100);
  result.diagnoses.front()->findings = {finding};
  result.job.include = {"spindle.radial_synchronous"};
  return result;
}

Inclusion inclusion_of(const JobResult& result) {
  return included_motions(result).inclusions.at(0);
}

std::string why_of(const JobResult& result) { return words_of(*inclusion_of(result).why); }

TEST(Inclusion, AMotionOfTheSpindleAloneIsFollowed) {
  JobResult result = asked(spindle_lobes());
  const auto motions = included_motions(result).motions;
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_TRUE(inclusion_of(result).included);
}

TEST(Inclusion, AClassThatHoldsTheFormIsRefusedByName) {
  Finding finding = spindle_lobes();
  finding.rivals = {{"part.roundness", 0.0, 0.0, 0.5, true}};
  JobResult result = asked(finding);
  EXPECT_TRUE(included_motions(result).motions.empty());
  EXPECT_TRUE(inclusion_of(result).refused);
  EXPECT_NE(why_of(result).find("part.roundness"), std::string::npos);
  finding.term.effect = find_effect("probe.nonlinearity");
  finding.rivals = {{"spindle.radial_synchronous", 0.0, 0.0, 0.5, true}};
  result = asked(finding);
  EXPECT_TRUE(included_motions(result).motions.empty());
  EXPECT_NE(why_of(result).find("probe.nonlinearity"), std::string::npos);
}

// Near a whole order noise keeps a line of a free order in the class: 0.1 to 2 % were seen.
TEST(Inclusion, WhatIsPossibleByChanceAloneForbidsNothing) {
  Finding finding = spindle_lobes();
  finding.probability = 0.982;
  finding.rivals = {{"environment.vibration", 1.8, -2.7, 0.010, true},
                    {"spindle.asynchronous", 1.0, -2.4, 0.008, true}};
  JobResult result = asked(finding);
  EXPECT_EQ(included_motions(result).motions.size(), 1u);
  EXPECT_TRUE(inclusion_of(result).included);
  EXPECT_NE(why_of(result).find("environment.vibration"), std::string::npos);
  EXPECT_NE(why_of(result).find("0.018"), std::string::npos);
  // Together above the risk of a go they forbid, though each is below.
  finding.rivals[0].probability = finding.rivals[1].probability = 0.03;
  result = asked(finding);
  EXPECT_TRUE(included_motions(result).motions.empty());
  EXPECT_TRUE(inclusion_of(result).refused);
}

TEST(Inclusion, WhatWasNotFoundIsNoRefusal) {
  JobResult result = asked(example::tilt_motion());
  EXPECT_TRUE(included_motions(result).motions.empty());
  EXPECT_FALSE(inclusion_of(result).refused);
  EXPECT_EQ(inclusion_of(result).why->code, ReasonCode::not_found);
}

TEST(Inclusion, AToolBesideTheProbesDirectionIsRefused) {
  JobResult result = asked(spindle_lobes());
  result.job.tool.angle_from_probe_rad = 0.5;
  EXPECT_TRUE(included_motions(result).motions.empty());
  EXPECT_TRUE(inclusion_of(result).refused);
}

// A slide's path is known where it was probed; a motion of the spindle is the same everywhere, if
// it is told from one that grows along Z.
TEST(Inclusion, AMotionOfTheMachineIsFollowedWithinTheProbedLength) {
  for (const bool beyond : {false, true}) {
    for (const char* id : {"slide.z_straightness", "spindle.radial_synchronous", "tilt as well"}) {
      Finding finding = spindle_lobes();
      const bool tilt = std::string_view(id) == "tilt as well";
      if (tilt) {
        id = "spindle.radial_synchronous";
        finding.probability = 0.6;
        finding.rivals = {{"spindle.tilt_synchronous", 0.0, 0.0, 0.4, true}};
      }
      finding.term.effect = find_effect(id);
      JobResult result = asked(finding);
      result.job.include = {id};
      const Diagnosis& diagnosis = *result.diagnoses.front();
      result.job.target->z_start_mm = diagnosis.z_mid_mm;
      result.job.target->z_end_mm = diagnosis.z_mid_mm + (beyond ? 2.0 : 1.0) * diagnosis.z_half_mm;
      const bool refused = beyond && (tilt || finding.term.effect->frame == EffectFrame::machine);
      EXPECT_EQ(included_motions(result).motions.empty(), refused) << id;
      EXPECT_EQ(inclusion_of(result).refused, refused) << id;
    }
  }
}

/// The spindle carries the part towards the probe by m(C): a tool at X cuts the radius X − m on the
/// probe's side and X + m on the other. With the motion followed the part gets the radius of the
/// programmed profile, whatever the angle.
TEST(Inclusion, TheCutPartIsTrueOnBothSides) {
  JobResult result = asked(spindle_lobes());
  const auto motions = included_motions(result).motions;
  const TargetSurface& target = *result.job.target;
  for (const double turn : {0.0, two_pi / 2.0}) {
    ToolSetup tool = result.job.tool;
    tool.angle_from_probe_rad = turn;
    const double towards_tool = turn == 0.0 ? 1.0 : -1.0;
    const Profile plain({}, target, tool), followed({}, target, tool, motions);
    for (int degree = 0; degree < 360; degree += 7) {
      const double c = degree * rad_per_deg;
      const double m =
          example::lobes_mm * std::cos(3.0 * c - example::lobes_phase_deg * rad_per_deg);
      const double cut = followed.at(c, 20.0) - towards_tool * m;
      EXPECT_NEAR(cut, plain.at(c, 20.0), 1e-12) << degree;
    }
  }
}

/// An axial motion moves X by tan α of the surface that is cut: a cylinder does not see it.
TEST(Inclusion, AnAxialMotionActsThroughTheSlopeOfTheTarget) {
  const RepeatingMotion axial{
      example::fitted("spindle.axial_synchronous", {.order = 2.0}, {0.004, 0.0})};
  EXPECT_EQ(motion_mm(axial, 0.3, 10.0, 0.0), 0.0);
  EXPECT_NEAR(motion_mm(axial, 0.3, 10.0, 0.1), 0.1 * 0.004 * std::cos(0.6), 1e-15);
}

}  // namespace
}  // namespace trueaxis
