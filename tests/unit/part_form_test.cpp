// SPDX-License-Identifier: Apache-2.0
// Form of a part on the virtual lathe without what is not of it, against values by analysis; and
// ISO 14253-1.
#include "trueaxis/part_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "job/part_form_steps.hpp"
#include "support/diagnose_lathe.hpp"
#include "support/form_profiles.hpp"

namespace trueaxis::testing {
namespace {

constexpr double sigma_mm = 2e-4;

/// Sections at six Z with 211 readings per revolution: 1-15 UPR takes 105. The part runs true, so
/// that the readings do not tell its angle from the spindle's.
virtual_lathe::Scenario sections_of_a_shaft(std::uint64_t seed) {
  virtual_lathe::Scenario scenario = one_pass(0.0, 6.0, sigma_mm);
  scenario.seed = seed;
  scenario.part.x0_mm = 0.01, scenario.part.y0_mm = -0.01;
  scenario.part.l = scenario.part.m = 0.0;
  scenario.plan.passes.clear();
  for (int i = 0; i < 6; ++i) {
    virtual_lathe::PlannedPass pass;
    pass.start_mm = pass.end_mm = 10.0 * i;
    pass.readings_per_revolution = 211.0;
    pass.revolutions = 1.0;
    pass.speed_rpm = 60.0;
    scenario.plan.passes.push_back(pass);
  }
  return scenario;
}

/// A helix of 24 turns with 53 readings each, in which a vibration of no whole order is found.
virtual_lathe::Scenario vibrating_helix(std::uint64_t seed) {
  virtual_lathe::Scenario scenario = one_pass(0.0, 24.0, sigma_mm);
  scenario.seed = seed;
  scenario.plan.passes.front().readings_per_revolution = 53.0;
  scenario.effects = {{"environment.vibration",
                       {{"amplitude_mm", 1e-3}, {"frequency_hz", 5.37}, {"phase_rad", 0.3}}}};
  return scenario;
}

struct Case {
  ProbeStream stream;
  Diagnosis diagnosis;
  PartForm form;
};

Case assessed(const virtual_lathe::Scenario& scenario, const FormTask& task = {}) {
  Case out{virtual_lathe::simulate(scenario), {}, {}};
  const DiagnoseOptions options = on_one_core(scenario);
  out.diagnosis = diagnose(out.stream, options);
  out.form = part_form({out.stream, &out.diagnosis}, options.fit, task);
  return out;
}

/// What a Gaussian filter of 50 % at the cut-off lets through (ISO 16610-21).
double let_through(double upr, double cut_off) {
  return std::exp(-std::log(2.0) * upr * upr / (cut_off * cut_off));
}

double U_of(const FormValue& one) { return 2.0 * one.estimate.u; }

TEST(PartForm, LobesThatMayBeTheSpindlesStandWithAndWithout) {
  virtual_lathe::Scenario scenario = sections_of_a_shaft(11);
  scenario.effects = {
      {"part.roundness", {{"order", 3.0}, {"amplitude_mm", 4e-3}, {"phase_rad", 0.7}}}};
  const Case one = assessed(scenario);
  ASSERT_EQ(one.form.why_not, "");
  ASSERT_EQ(one.form.probed.options.high_upr, 15.0);
  ASSERT_NE(finding_with(one.diagnosis, "spindle.radial_synchronous"), nullptr);
  ASSERT_EQ(one.form.open.size(), 1u);
  EXPECT_TRUE(one.form.motion.empty());
  // Peak to valley of three lobes is twice their amplitude about any of the circles.
  const double expected = 2.0 * 4e-3 * let_through(3.0, 15.0);
  const FormValue* with = worst_value(one.form.with_open(), "RONt", "MZCI");
  const FormValue* without = worst_value(one.form.without_open(), "RONt", "MZCI");
  ASSERT_TRUE(with && without);
  // The worst of six sections is above the mean by less than U.
  EXPECT_NEAR(with->estimate.value, expected, 1.5 * U_of(*with));
  // Noise alone: its bias is in u, so that 0 is within U; the worst of six.
  EXPECT_LT(without->estimate.value, 1.5 * U_of(*without));
  EXPECT_LT(without->estimate.value, 0.1 * expected);
}

/// A vibration of no whole order is at another phase at every revolution: it is noise to the
/// surface, whose bound stays below the 2 × 1 µm that a single turn would show.
TEST(PartForm, AVibrationIsNoFormOfASurface) {
  const Case one = assessed(vibrating_helix(15));
  ASSERT_EQ(one.form.why_not, "");
  ASSERT_EQ(one.form.motion, std::vector<std::string>{"environment.vibration"});
  EXPECT_TRUE(one.form.open.empty());
  const FormValue* probed = worst_value(one.form.probed, "RONt", "MZCI");
  const FormValue* of_part = worst_value(one.form.with_open(), "RONt", "MZCI");
  ASSERT_TRUE(probed && of_part);
  EXPECT_LT(size_of(*probed), 1e-3);
  // The part is round: 0 is within U of the noise.
  EXPECT_LE(least_of(*of_part, 2.0), 0.0);
  EXPECT_LT(size_of(*of_part), 1e-3);
}

TEST(PartForm, TermsOfFindingsAddUpToTheEffect) {
  virtual_lathe::Scenario scenario = vibrating_helix(13);
  scenario.effects.push_back(
      {"part.roundness", {{"order", 3.0}, {"amplitude_mm", 4e-3}, {"phase_rad", 0.7}}});
  const Case one = assessed(scenario);
  ASSERT_EQ(one.diagnosis.findings.size(), 2u);
  ASSERT_TRUE(one.diagnosis.unexplained.empty());
  std::vector<const Finding*> all;
  for (const Finding& finding : one.diagnosis.findings) all.push_back(&finding);
  const auto columns = motion_columns({one.stream, &one.diagnosis}, all, 0.0);
  ASSERT_EQ(columns.size(), 2u);
  // The terms are linearised about the same part: what differs is of second order, some
  // (0.2 mm/40 mm)² of 7 µm.
  for (std::size_t i = 0; i < one.stream.size(); ++i)
    ASSERT_NEAR(columns[0].sum_mm[i] + columns[1].sum_mm[i], one.diagnosis.effect_mm[i], 2e-6);
}

TEST(PartForm, ToleranceIsHeldByIso14253) {
  virtual_lathe::Scenario scenario = sections_of_a_shaft(15);
  FormTask far;  // as many trials as every judgement
  far.band_upr = {1.0, 15.0};
  far.cylindricity_tolerance_mm = 1.0;
  const Case none = assessed(scenario, far);
  const double value = worst_value(none.form.probed, "CYLt", "MZCY")->estimate.value;
  const double U = U_of(*worst_value(none.form.probed, "CYLt", "MZCY"));
  ASSERT_GT(value, U * 0.2);
  const auto conformity = [&](double tolerance_mm) {
    FormTask task;
    task.band_upr = {1.0, 15.0};
    task.cylindricity_tolerance_mm = tolerance_mm;
    const PartForm form =
        part_form({none.stream, &none.diagnosis}, on_one_core(scenario).fit, task);
    EXPECT_EQ(form.met(), form.judgements.front().conformity == Conformity::met);
    return form.judgements.front().conformity;
  };
  EXPECT_EQ(conformity(1.01 * (value + U)), Conformity::met);
  EXPECT_EQ(conformity(0.99 * (value + U)), Conformity::not_proven);
}

/// The readings leave open whose three lobes are: 8 µm with them, next to nothing without.
TEST(PartForm, WhatIsOpenIsNotProven) {
  virtual_lathe::Scenario scenario = sections_of_a_shaft(11);
  scenario.effects = {
      {"part.roundness", {{"order", 3.0}, {"amplitude_mm", 4e-3}, {"phase_rad", 0.7}}}};
  FormTask task;
  task.band_upr = {1.0, 15.0};
  for (const auto& [tolerance_mm, expected] :
       {std::pair{9e-3, Conformity::met}, std::pair{5e-3, Conformity::not_proven},
        std::pair{1e-4, Conformity::not_proven}}) {
    task.roundness_tolerance_mm = tolerance_mm;
    EXPECT_EQ(assessed(scenario, task).form.judgements.front().conformity, expected)
        << tolerance_mm;
  }
}

/// Readings without a diagnosis are what they are: 8 µm, of which 1-15 UPR lets 7.8 µm through.
TEST(PartForm, LobesAboveTheToleranceAreNotMet) {
  virtual_lathe::Scenario scenario = sections_of_a_shaft(11);
  scenario.effects = {
      {"part.roundness", {{"order", 3.0}, {"amplitude_mm", 4e-3}, {"phase_rad", 0.7}}}};
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  FormTask task;
  task.band_upr = {1.0, 15.0};
  task.roundness_tolerance_mm = 5e-3;
  const PartForm form = part_form({stream, nullptr}, on_one_core(scenario).fit, task);
  EXPECT_EQ(form.judgements.front().conformity, Conformity::not_met);
  EXPECT_FALSE(form.met());
}

TEST(PartForm, WhatTheReadingsDoNotCarryIsNotJudged) {
  virtual_lathe::Scenario scenario = one_pass(0.0, 20.0, sigma_mm);
  scenario.seed = 16;
  FormTask task;
  task.roundness_tolerance_mm =
      0.1;  // 1-50 by default: 350 readings per revolution, of which 24 are there
  const Case one = assessed(scenario, task);
  ASSERT_EQ(one.form.judgements.size(), 1u);
  EXPECT_EQ(one.form.judgements.front().conformity, Conformity::not_judged);
  EXPECT_NE(one.form.judgements.front().why.find("350 readings per revolution"), std::string::npos);
  EXPECT_FALSE(one.form.met());
  // Without a tolerance the widest standard band that 474 angles of one surface carry.
  const Case free = assessed(scenario);
  EXPECT_EQ(free.form.why_not, "");
  EXPECT_EQ(free.form.probed.options.high_upr, 15.0);
  EXPECT_TRUE(free.form.probed.surface);
}

}  // namespace
}  // namespace trueaxis::testing
