// SPDX-License-Identifier: Apache-2.0
// A gauge's readings are those of X_M less its zero: the diagnosis says the same of both.
#include <gtest/gtest.h>

#include <iostream>

#include "support/diagnose_lathe.hpp"

namespace trueaxis::testing {
namespace {

constexpr std::uint64_t seed = 12;
constexpr double sigma_mm = 1e-3, chip_mm = 0.05;

/// Three lobes of 2 σ and a chip of 50 σ every 40 readings; relative to the part's radius or not.
Diagnosis diagnosis_of(double turns, bool gauge) {
  virtual_lathe::Scenario scenario = one_pass(0.0, turns, sigma_mm);
  scenario.effects = {
      {"part.roundness", {{"order", 3}, {"amplitude_mm", 2e-3}, {"phase_rad", 0.7}}}};
  scenario.seed = seed;
  if (gauge) {
    scenario.probe.relative_zero_mm = scenario.part.radius_mm;
    scenario.probe.nominal_radius_mm = scenario.part.radius_mm;
  }
  ProbeStream stream = virtual_lathe::simulate(scenario);
  for (std::size_t i = 7; i < stream.size(); i += 40) stream.reading_mm[i] += chip_mm;
  return diagnose(stream, on_one_core(scenario));
}

class DiagnoseGauge : public ::testing::TestWithParam<double> {};

// The two fits differ in the constant that is free, the radius or the zero: by (e/R)² of it, far
// below σ.
TEST_P(DiagnoseGauge, ItsZeroIsNeitherNoiseNorForm) {
  std::cout << "seed " << seed << '\n';
  const Diagnosis plain = diagnosis_of(GetParam(), false), gauge = diagnosis_of(GetParam(), true);
  const auto masked = [](const Diagnosis& d) {
    std::vector<std::size_t> rows;
    for (const Rejected& r : d.noise.masked) rows.push_back(r.row);
    return rows;
  };
  EXPECT_EQ(masked(gauge), masked(plain));
  EXPECT_NEAR(gauge.noise.sigma_mm, plain.noise.sigma_mm, 0.01 * sigma_mm);
  ASSERT_EQ(plain.findings.size(), 1u);
  ASSERT_EQ(gauge.findings.size(), 1u);
  EXPECT_EQ(gauge.findings[0].members(), plain.findings[0].members());
}

INSTANTIATE_TEST_SUITE_P(Turns, DiagnoseGauge, ::testing::Values(5.3, 20.3));

}  // namespace
}  // namespace trueaxis::testing
