// SPDX-License-Identifier: Apache-2.0
// An effect of a machine that nobody knows: its entry is all that the diagnosis needs to find it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "report/machine_report.hpp"
#include "support/ball_bench.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::testing {
namespace {

constexpr double sigma_mm = 1e-3, amplitude_mm = 0.006;

/// The table rises and falls with the tilt of A, three times over half a turn: an order that no
/// entry has, in an error of C as a function of A.
MachineEffect lift_by_tilt() {
  MachineEffect own;
  own.id = "own.lift_by_tilt";
  own.title = "the table lifts as A tilts";
  own.term = ErrorOfPosition{*parse_error_name("EZC"),
                             {FourierError{{{1.0, 1.0, 0.0}}, 60.0 * rad_per_deg},
                              FourierError{{{1.0, 0.0, 1.0}}, 60.0 * rad_per_deg}},
                             AxisName::A};
  own.parameters = {"cos", "sin"};
  own.formula = "cos cos(6 A) + sin sin(6 A)";
  own.shape = {{"order", 6.0, "1"}};
  own.low = 1e-3, own.high = 0.02;
  own.consequence = "tighten the clamp of A";
  return own;
}

MachineMeasurement lifted(double size_mm) {
  const Machine machine = trunnion();
  Draw draw(31);
  const ErrorModel truth = drawn_location_errors(machine, draw);
  BallPlan plan;
  plan.a_deg.clear();
  for (int k = 0; k <= 8; ++k) plan.a_deg.push_back(-10.0 * k);
  plan.c_deg.clear();
  for (int k = 0; k < 12; ++k) plan.c_deg.push_back(30.0 * k);
  const BallBench bench{machine, truth};
  MachineMeasurement data = measure_balls(bench, plan, sigma_mm, draw);
  // EZC moves the ball along the Z of C's own frame: at A = 0 that of the machine, tilted with A.
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const double a = data.axes[i][index_of(AxisName::A)];
    AxisPositions tilted{};
    tilted[index_of(AxisName::A)] = a;
    const Vector3 along = turned(bench.workpiece(tilted), {0.0, 0.0, 1.0});
    for (std::size_t k = 0; k < 3; ++k)
      data.deviation_mm[i][k] += size_mm * std::cos(6.0 * a - 0.7) * along[k];
  }
  return data;
}

TEST(OwnMachineEffect, IsFoundByItsEntryAndNamedWithItsConsequence) {
  const Machine machine = trunnion();
  const MachineMeasurement data = lifted(amplitude_mm);
  const MachineEffect own[] = {lift_by_tilt()};
  MachineDiagnoseOptions options;
  options.own_effects = own;
  const MachineDiagnosis found = diagnose_machine(machine, std::span(&data, 1), options);
  for (const MachineFinding& one : found.findings)
    std::cout << one.effect() << ' ' << one.size << ' ' << one.probability << '\n';
  ASSERT_EQ(found.findings.size(), 1U);
  const MachineFinding& one = found.findings.front();
  EXPECT_EQ(one.effect(), "own.lift_by_tilt");
  EXPECT_EQ(one.cause.consequence, "tighten the clamp of A");
  EXPECT_TRUE(
      one.errors.empty());  // for another axis it is not an error that a program is corrected by
  ASSERT_EQ(one.parameters.size(), 2U);
  const double u = std::hypot(one.parameters[0].estimate.u, one.parameters[1].estimate.u);
  EXPECT_NEAR(one.size, amplitude_mm, 4.0 * u);
  EXPECT_LT(u, 0.1 * amplitude_mm);
  EXPECT_EQ(found.verdict, DiagnosisVerdict::effects);
}

// Screen, file and page have its words from the entry, and nothing else has to know it.
TEST(OwnMachineEffect, IsCalledByItsTitleEverywhere) {
  const MachineMeasurement data = lifted(amplitude_mm);
  const MachineEffect own[] = {lift_by_tilt()};
  MachineDiagnoseOptions options;
  options.own_effects = own;
  MachineJobResult result;
  result.job.machine = trunnion();
  result.diagnosis = diagnose_machine(result.job.machine, std::span(&data, 1), options);
  const std::string screen = machine_diagnosis_screen(result.diagnosis);
  EXPECT_NE(screen.find("the table lifts as A tilts: tighten the clamp of A\n"), std::string::npos)
      << screen;
  const Json file = machine_diagnosis_object(result.diagnosis, result.job.machine);
  EXPECT_EQ(file.at("effects").at("own.lift_by_tilt").at("title"), "the table lifts as A tilts");
  EXPECT_EQ(file.at("consequences").at("own.lift_by_tilt"), "tighten the clamp of A");
  EXPECT_EQ(machine_report_data(result).at("titles").at("own.lift_by_tilt"),
            "the table lifts as A tilts");
}

// What the entry adds: without it no name of the catalogue is right, and nothing is named alone.
TEST(OwnMachineEffect, IsNotNamedWithoutItsEntry) {
  const MachineMeasurement data = lifted(amplitude_mm);
  const MachineDiagnosis found = diagnose_machine(trunnion(), std::span(&data, 1));
  EXPECT_NE(found.verdict, DiagnosisVerdict::ideal);
  EXPECT_TRUE(std::ranges::none_of(found.findings, [](const MachineFinding& one) {
    return one.effect() == "own.lift_by_tilt";
  }));
}

// And where nothing is, an entry alone finds nothing.
TEST(OwnMachineEffect, IsSilentWhereItIsNot) {
  const MachineMeasurement data = lifted(0.0);
  const MachineEffect own[] = {lift_by_tilt()};
  MachineDiagnoseOptions options;
  options.own_effects = own;
  EXPECT_EQ(diagnose_machine(trunnion(), std::span(&data, 1), options).verdict,
            DiagnosisVerdict::ideal);
}

}  // namespace
}  // namespace trueaxis::testing
