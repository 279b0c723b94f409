// SPDX-License-Identifier: Apache-2.0
// A vibration of nearly the spindle's frequency shifts each section of a part another way. It was
// taken for slips, a bend or correlated noise, and nine of eleven GOs were wrong.
#include <gtest/gtest.h>

#include <algorithm>

#include "job/doubts.hpp"
#include "job/files/job_words.hpp"
#include "laws/turned_cylinder.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

/// Five sections of three turns, 2 s from one to the next.
Scenario in_sections(std::uint64_t seed) {
  Scenario scenario = turned_cylinder(seed, 25.0, 0.001);
  PlannedPass section = scenario.plan.passes[0];
  section.revolutions = 3.0, section.readings_per_revolution = 48.0, section.pause_s = 2.0;
  scenario.plan.passes.clear();
  for (int i = 0; i < 5; ++i) {
    section.start_mm = section.end_mm = 10.0 * i;
    scenario.plan.passes.push_back(section);
  }
  return scenario;
}

Scenario shaken(std::uint64_t seed, double frequency_hz) {
  Scenario scenario = in_sections(seed);
  scenario.effects = {{"environment.vibration",
                       {{"amplitude_mm", 0.003},
                        {"frequency_hz", frequency_hz},
                        {"phase_rad", 0.7 * static_cast<double>(seed)}}}};
  return scenario;
}

TEST(VibrationInSections, IsNamedAndTheAxisIsThatOfThePart) {
  for (const double frequency_hz : {0.89, 1.12, 2.31}) {
    const Scenario scenario = shaken(3, frequency_hz);
    const ProbeStream stream = simulate(scenario);
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    ASSERT_EQ(diagnosis.findings.size(), 1u) << frequency_hz;
    const Finding& found = diagnosis.findings.front();
    EXPECT_EQ(found.effect(), "environment.vibration");
    const Estimate& amplitude = found.parameter("amplitude");
    EXPECT_NEAR(amplitude.value, 0.003, amplitude.expanded(3.0)) << frequency_hz;
    const auto why = why_axis_unknown(stream, diagnosis);
    EXPECT_FALSE(why) << frequency_hz << words_of(*why);
    expect_axis_after(scenario, 0.0, 0.0, 40.0, diagnosis);
  }
}

TEST(VibrationInSections, IsNotFoundWhereThereIsNone) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(in_sections(seed)));
    EXPECT_EQ(diagnosis.verdict, DiagnosisVerdict::ideal) << seed;  // one of 17 such tests at 1 %
  }
}

}  // namespace
}  // namespace trueaxis::testing
