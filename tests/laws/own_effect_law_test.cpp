// SPDX-License-Identifier: Apache-2.0
// An effect that nobody knows: its entry is all that the diagnosis needs to find it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "support/diagnose_lathe.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

constexpr double sigma_mm = 0.001, amplitude_mm = 0.006, phase_rad = 0.7;

const Effect five_at_the_ends{
    .id = "own.five_at_the_ends",
    .title = "five undulations towards both ends",
    .term = Harmonic{Harmonic::Angle::part, Harmonic::Envelope::parabola, TermPort::normal, 5.0},
    .parameters = {{"amplitude", "mm", 1e-3, 0.02, "at the ends"}},
    .consequence = "grind both ends again",
    .needs = {.length = true}};
const Effect three_starts{.id = "own.three_starts",
                          .title = "a spiral of three starts",
                          .term = PeriodicInZ{TermPort::normal, 3.0},
                          .parameters = {{"amplitude", "mm", 1e-3, 0.02, "at its tops"},
                                         {"lead", "mm", 2, 50, "", "period_mm"}},
                          .needs = {.length = true},
                          .typical = {{&TermShape::period_mm, {7.0}}},
                          .search = {SearchRange::When::scanned},
                          .line = SpectralLine{SpectralLine::In::spiral, 0.02, 0.5}};
constexpr double lead_mm = 7.3;

/// A cylinder out at 60 rpm and back at 151 rpm, with a form along its normal in formulas of the
/// test's own. They use the polar angle about the axis, and Z, which goes from 0 to 60 over the
/// probed length.
ProbeStream with_form(const std::function<double(double, double)>& form_mm) {
  virtual_lathe::Scenario scenario = one_pass(0.0, 30.0, sigma_mm);
  virtual_lathe::PlannedPass back = scenario.plan.passes[0];
  std::swap(back.start_mm, back.end_mm);
  back.speed_rpm = 151.0;
  scenario.plan.passes.push_back(back);
  std::cout << "seed " << scenario.seed << '\n';
  ProbeStream stream = simulate(scenario);
  const virtual_lathe::Part& part = scenario.part;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double x = stream.reading_mm[i], c = stream.c_rad[i], z = stream.position_mm[i];
    const double angle = std::atan2(x * std::sin(c) - part.y0_mm - part.m * z,
                                    x * std::cos(c) - part.x0_mm - part.l * z);
    stream.reading_mm[i] += form_mm(angle, z);
  }
  return stream;
}

Diagnosis diagnosed(const ProbeStream& stream, std::span<const Effect> own) {
  DiagnoseOptions options = on_one_core(one_pass(0.0, 30.0, sigma_mm));
  options.own_effects = own;
  return diagnose(stream, options);
}

/// u of cos and sin of a form in white noise: σ √(2/(N f)), f the mean square of its envelope;
/// five of them.
double five_u_mm(const ProbeStream& stream, double mean_square) {
  return 5.0 * sigma_mm * std::sqrt(2.0 / (static_cast<double>(stream.size()) * mean_square));
}

TEST(OwnEffect, IsFoundByItsEntry) {
  const ProbeStream stream = with_form([](double angle, double z) {
    const double u = z / 30.0 - 1.0;
    return amplitude_mm * u * u * std::cos(5.0 * angle - phase_rad);
  });
  const Diagnosis known = diagnosed(stream, {&five_at_the_ends, 1});
  ASSERT_EQ(known.findings.size(), 1u) << known.findings.back().effect();
  EXPECT_EQ(known.verdict, DiagnosisVerdict::effects);
  const Finding& found = known.findings[0];
  EXPECT_EQ(found.effect(), five_at_the_ends.id);
  const double tolerance = five_u_mm(stream, 0.2);  // ∫ u⁴ over −1 … 1 is 2/5
  EXPECT_NEAR(parameter_of(found, "amplitude")->value, amplitude_mm, tolerance);
  EXPECT_NEAR(parameter_of(found, "phase")->value, phase_rad, tolerance / amplitude_mm);

  const std::string named = "five undulations towards both ends: grind both ends again";
  EXPECT_NE(diagnosis_screen(known).find(named), std::string::npos) << diagnosis_screen(known);
  const auto json = nlohmann::json::parse(diagnosis_json(known));
  EXPECT_EQ(json.at("findings").at(0).at("effect"), five_at_the_ends.id);
  EXPECT_EQ(json.at("consequences").at(std::string(five_at_the_ends.id)),
            five_at_the_ends.consequence);

  const Diagnosis unknown = diagnosed(stream, {});
  EXPECT_EQ(finding_with(unknown, std::string(five_at_the_ends.id)), nullptr);
  EXPECT_EQ(unknown.verdict, DiagnosisVerdict::unexplained);
}

TEST(OwnEffect, IsScannedForAsALine) {
  const ProbeStream stream = with_form([](double angle, double z) {
    return amplitude_mm * std::cos(two_pi * z / lead_mm - 3.0 * angle + phase_rad);
  });
  const std::array own{five_at_the_ends, three_starts};
  const Diagnosis known = diagnosed(stream, own);
  ASSERT_EQ(known.findings.size(), 1u);
  const Finding& found = known.findings[0];
  EXPECT_EQ(found.effect(), three_starts.id);
  const double tolerance = five_u_mm(stream, 1.0);
  EXPECT_NEAR(parameter_of(found, "amplitude")->value, amplitude_mm, tolerance);
  // u of a frequency over a length L is u of the phase times √12/L.
  const double wide = tolerance / amplitude_mm * std::sqrt(12.0) / 60.0 / two_pi;
  EXPECT_NEAR(1.0 / parameter_of(found, "lead")->value, 1.0 / lead_mm, wide);

  const Diagnosis unknown = diagnosed(stream, {});
  EXPECT_EQ(finding_with(unknown, std::string(three_starts.id)), nullptr);
  EXPECT_EQ(unknown.verdict, DiagnosisVerdict::unexplained);
}

TEST(OwnEffect, HasAnIdOfItsOwn) {
  Effect taken = five_at_the_ends;
  taken.id = effect_catalogue().front().id;
  EXPECT_THROW(diagnosed(simulate(one_pass(0.0, 30.0, sigma_mm)), {&taken, 1}), ContractViolation);
}

}  // namespace
}  // namespace trueaxis::testing
