// SPDX-License-Identifier: Apache-2.0
// A slip that is sure is said; one that is not, or cannot be excluded, forbids the table.
#include "job/slip.hpp"

#include <gtest/gtest.h>

#include "diagnose/files/diagnosis_text.hpp"
#include "job/files/job_words.hpp"
#include "support/diagnosis_example.hpp"

namespace trueaxis {
namespace {

Finding slipped(std::vector<FitParameter> parameters) {
  Finding finding;
  finding.term.effect = find_effect("part.slip");
  finding.parameters = std::move(parameters);
  finding.parameters.push_back(example::parameter("onset", 11.982, 0.012, "s"));
  finding.probability = 1.0;
  finding.axis_shift = {0.022, 5e-4, "mm", ""};
  return finding;
}

std::string objection(const JobResult& result) {
  return words_of(part_slipped(result), "; ", result);
}

std::string moved(const JobResult& result) { return words_of(moved_part(result), "; ", result); }

JobResult found(const std::vector<Finding>& findings) {
  JobResult result = example::diagnosed_job(100);
  result.job.references.front().name = "seat";
  result.diagnoses.front()->findings = findings;
  result.diagnoses.front()->unexplained.clear();
  result.diagnoses.front()->baseline.coverage_factor = 2.0;
  return result;
}

/// Sure but for a pattern that nobody explains.
JobResult unsure(const std::vector<Finding>& findings) {
  JobResult result = found(findings);
  result.diagnoses.front()->unexplained.emplace_back();
  return result;
}

TEST(Slip, OneThatIsSureIsNoObjection) {
  const Finding step = slipped(
      {example::parameter("dx", 0.012, 0.003, "mm"), example::parameter("dy", 0.016, 0.001, "mm")});
  EXPECT_EQ(objection(found({step})), "");
  EXPECT_EQ(moved(found({step})),
            "seat: the part slipped in the chuck at 12.0 s by 20.0 ± 3.9 µm: the axis given is "
            "that of the part after the slip");
  EXPECT_EQ(moved(unsure({step})), "");
}

TEST(Slip, TwoOrOneWithRivalsAreNotSure) {
  Finding step = slipped({example::parameter("dx", 0.012, 0.003, "mm")});
  EXPECT_NE(objection(found({step, step})), "");
  step.rivals = {{"part.bow", 0.4, 1.1, 0.37, false}};
  EXPECT_NE(objection(found({step})), "");
}

// A verdict takes a risk of 5 %. What several causes have of it adds up; from one half on,
// `diagnose` gives no axis either.
TEST(Slip, InTheClassOfAnotherCauseForbidsFromTheRiskOfAVerdictOn) {
  Finding bow;
  bow.term.effect = find_effect("part.bow");
  const auto rivals = [&](double slip, double creep) {
    bow.rivals = {{"part.slip", 0.4, 1.1, slip, false}, {"part.creep", 0.4, 1.1, creep, false}};
    bow.probability = 1.0 - slip - creep;
    return found({bow});
  };
  EXPECT_EQ(objection(rivals(0.02, 0.02)), "");
  EXPECT_NE(objection(rivals(0.03, 0.03)), "");
  EXPECT_FALSE(is_likely_slip(*rivals(0.2, 0.2).diagnoses.front()));
  EXPECT_TRUE(is_likely_slip(*rivals(0.3, 0.3).diagnoses.front()));
}

// What a slip and its rival cause make of the axis is in the average: if both leave it where it is
// within U, nothing forbids the table.
TEST(Slip, WithARivalThatLeavesTheAxisWithinUIsNoObjection) {
  Finding step = slipped({example::parameter("turn", 0.006, 0.001, "rad")});
  step.rivals = {{"probe.latency", 0.4, 1.1, 0.86, false}};
  step.probability = 0.14;
  JobResult result = found({step});
  Diagnosis& diagnosis = *result.diagnoses.front();
  ASSERT_TRUE(diagnosis.extended.axis_known());
  const double U_mm =
      2.0 * std::max(diagnosis.extended.axis.u_at(diagnosis.extended.position_min_mm),
                     diagnosis.extended.axis.u_at(diagnosis.extended.position_max_mm));
  ASSERT_GT(U_mm, 0.0);
  const auto moves_axis_by = [&](double shift_mm) {
    diagnosis.shares = {{"probe.latency", "part.slip", 0.86, {shift_mm, 1e-4, "mm", ""}}};
    return objection(result);
  };
  EXPECT_EQ(moves_axis_by(0.5 * U_mm), "");
  EXPECT_NE(moves_axis_by(1.5 * U_mm), "");
  result.diagnoses.front()->findings.front().rivals.front().effect = "part.creep";  // goes on
  diagnosis.shares = {{"part.creep", "part.slip", 0.86, {0.0, 1e-4, "mm", ""}}};
  EXPECT_NE(objection(result), "");
  EXPECT_TRUE(is_likely_slip(diagnosis));
  EXPECT_FALSE(is_sure_slip(diagnosis));
}

TEST(Slip, OneThatLastsIsNotSure) {
  Finding slow = slipped(
      {example::parameter("dx", 0.012, 0.003, "mm"), example::parameter("dy", 0.016, 0.001, "mm")});
  slow.term.shape.duration_s = 6.5;
  EXPECT_EQ(objection(found({slow})),
            "seat: the part slipped in the chuck from 12.0 s to 18.5 s by 20.0 ± 3.9 µm: clamp it "
            "again and probe again");
  EXPECT_EQ(moved(found({slow})), "");
  slow.parameters.back() = example::parameter("onset", 400.0, 0.5, "reading");
  slow.term.shape.duration_s = 50.0;
  EXPECT_NE(objection(found({slow})).find("from reading 401 to 451 by"), std::string::npos);
}

TEST(Slip, AStepIsGivenAsItsLength) {
  // 3-4-5: u of the length is that along its direction, √(0.6² 3² + 0.8² 1²) = 1.97 µm.
  const Finding step = slipped(
      {example::parameter("dx", 0.012, 0.003, "mm"), example::parameter("dy", 0.016, 0.001, "mm")});
  EXPECT_EQ(objection(unsure({step})),
            "seat: the part slipped in the chuck at 12.0 s by 20.0 ± 3.9 µm: clamp it again and "
            "probe again");
}

TEST(Slip, ATurnIsGivenInDegrees) {
  const Finding turn = slipped({example::parameter("turn", 9.46, 0.5, "deg")});
  EXPECT_EQ(objection(unsure({turn})),
            "seat: the part slipped in the chuck at 12.0 s by 9.5 ± 1.0°: clamp it again and probe "
            "again");
}

TEST(Slip, AFaceSlipsAlongZAndTilts) {
  Finding seat = slipped({example::parameter("dz", -0.00801, 6e-5, "mm")});
  seat.term.effect = find_effect("part.seat_slip");
  const auto said = [&] { return moved(found({seat})); };
  EXPECT_EQ(said(),
            "seat: the part slipped in the chuck at 12.0 s by -8.01 ± 0.12 µm along Z: the axis "
            "given is that of the part after the slip");
  // 3-4-5 of tilt: u along it is √(0.6² 4² + 0.8² 1²) = 2.53 of the last digits.
  const FitParameter tilt_x = example::parameter("tilt_x", 0.003, 4e-4, "deg"),
                     tilt_y = example::parameter("tilt_y", 0.004, 1e-4, "deg");
  seat.parameters.insert(seat.parameters.end(), {tilt_x, tilt_y});
  EXPECT_NE(said().find("by -8.01 ± 0.12 µm along Z and 0.00500 ± 0.00051° of tilt: "),
            std::string::npos)
      << said();
  seat.parameters.erase(seat.parameters.begin());
  EXPECT_NE(said().find("at 12.0 s by 0.00500 ± 0.00051° of tilt: "), std::string::npos) << said();
}

TEST(Slip, AMemberOfTheClassMayHaveBeenOne) {
  Finding bow = example::tilt_motion();
  bow.term.effect = find_effect("part.bow");
  bow.rivals = {{"part.slip", 0.4, 1.1, 0.37, false}};
  EXPECT_EQ(
      objection(found({bow})),
      "seat: the part may have slipped in the chuck, which the data cannot tell from part.bow "
      "(probability of the slip 0.37): clamp it again and probe again");
}

TEST(Slip, TheNamedOneGoesBeforeThePossibleOne) {
  Finding bow = example::tilt_motion();
  bow.rivals = {{"part.slip", 0.4, 1.1, 0.37, false}};
  const Finding turn = slipped({example::parameter("turn", 9.46, 0.5, "deg")});
  EXPECT_NE(objection(found({bow, turn})).find("the part slipped"), std::string::npos);
}

TEST(Slip, NoSlipNoObjection) {
  EXPECT_EQ(objection(found({example::lobes(), example::tilt_motion()})), "");
  JobResult face = example::diagnosed_job(100);
  face.diagnoses = {std::nullopt};
  EXPECT_EQ(objection(face), "");
}

TEST(Slip, TheTextSaysWhoseAxisItIs) {
  const Finding turn = slipped({example::parameter("turn", 9.46, 0.5, "deg")});
  for (const bool slip : {true, false}) {
    const JobResult result = found({slip ? turn : example::lobes()});
    for (const std::string& text :
         {diagnosis_text(*result.diagnoses.front()), findings_text(*result.diagnoses.front())})
      EXPECT_EQ(text.find("that of the part after the slip") != std::string::npos, slip) << text;
  }
}

}  // namespace
}  // namespace trueaxis
