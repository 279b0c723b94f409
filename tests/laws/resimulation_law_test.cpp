// SPDX-License-Identifier: Apache-2.0
// The virtual lathe hides one effect of the catalogue; the diagnosis that names it at its size, as
// written to a file, plays back the very readings. Nothing of the engine's terms is evaluated: the
// numbers go from the catalogue through the file to the lathe.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/files/diagnosis_json.hpp"
#include "laws/lathe_bench.hpp"
#include "laws/lathe_cases.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/resimulation.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

namespace lathe = virtual_lathe;

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) size = std::max(size, std::abs(a[i] - b[i]));
  return size;
}

class ResimulationLaw : public ::testing::TestWithParam<LatheBench> {
 protected:
  void SetUp() override {
    ideal_ = lathe::simulate(GetParam().scenario());
    FitOptions options;
    options.surface = GetParam().tangent == 0.0 ? SurfaceKind::cylinder : SurfaceKind::cone;
    options.bore = GetParam().bore;
    diagnosis_.baseline = diagnosis_.named = diagnosis_.extended = fit(ideal_, options);
    ASSERT_EQ(diagnosis_.baseline.status, FitStatus::converged);
    diagnosis_.z_mid_mm = 0.5 * (LatheBench::start_mm + LatheBench::end_mm);
    diagnosis_.z_half_mm = 0.5 * (LatheBench::end_mm - LatheBench::start_mm);
  }

  ProbeStream measured(std::vector<lathe::Effect> effects) const {
    lathe::Scenario scenario = GetParam().scenario();
    scenario.effects = std::move(effects);
    return lathe::simulate(scenario);
  }

  SimulatedReadings again(const ProbeStream& stream, const Diagnosis& diagnosis) const {
    return resimulate(diagnosis_from_json(diagnosis_json(diagnosis), "diagnosis.json"), stream)
        .readings;
  }

  Diagnosis found(const LatheCase& one) const {
    Finding finding;
    finding.term.effect = find_effect(one.id);
    finding.term.shape = one.shape;
    for (const double linear : one.linear) finding.term.linear.push_back(one.size * linear);
    Diagnosis diagnosis = diagnosis_;
    diagnosis.findings = {finding};
    return diagnosis;
  }

  ProbeStream ideal_;
  Diagnosis diagnosis_;  ///< of the ideal part: nothing found
};

TEST_P(ResimulationLaw, TheIdealPartComesBack) {
  const SimulatedReadings simulated = again(ideal_, diagnosis_);
  // The fit of noise-free readings is exact to its step's end, 1e-9 mm at the axis.
  EXPECT_LT(largest_difference(simulated.before_mm, ideal_.reading_mm), 1e-8);
  EXPECT_EQ(simulated.before_mm, simulated.after_mm);
}

TEST_P(ResimulationLaw, EveryEffectOfTheCatalogueComesBack) {
  const double fit_mm = largest_difference(again(ideal_, diagnosis_).before_mm, ideal_.reading_mm);
  for (const LatheCase& one : lathe_cases()) {
    SCOPED_TRACE(one.id);
    const ProbeStream stream = measured({{one.id, one.lathe(one.size)}});
    const SimulatedReadings simulated = again(stream, found(one));
    const double hidden = largest_difference(stream.reading_mm, ideal_.reading_mm);
    const double before = largest_difference(stream.reading_mm, simulated.before_mm);
    const double after = largest_difference(stream.reading_mm, simulated.after_mm);
    EXPECT_NEAR(before, hidden, fit_mm + 1e-12);
    // Phases and times pass through text and back: 1e-6 of the effect is far below any wrong sign,
    // phase, frame or factor.
    EXPECT_LT(after, fit_mm + 1e-6 * hidden + 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, ResimulationLaw,
                         ::testing::Values(LatheBench{"Cone", 0.1}, LatheBench{"Cylinder"},
                                           LatheBench{"ConeFromTheRear", -0.2, false, true},
                                           LatheBench{"ConicalBore", 0.1, true}),
                         [](const auto& bench) { return bench.param.name; });

// A ball touches a cone r sin α from below or above its centre. If a wave is assumed at the
// centre, it comes back out of phase: here by 0.39 mm of 1.5 mm, with 1.5 times the wave left.
TEST(ResimulationOfACone, AWaveIsWhereTheBallTouches) {
  for (const bool bore : {false, true}) {
    lathe::Scenario scenario = LatheBench{"", std::tan(15.0 * rad_per_deg), bore}.scenario();
    scenario.probe.ball_radius_mm = 1.5;
    scenario.noise.sigma_mm = 5e-4;
    scenario.effects = {{"part.waviness", {{"amplitude_mm", 0.002}, {"wavelength_mm", 1.5}}}};
    const ProbeStream stream = lathe::simulate(scenario);
    DiagnoseOptions options;
    options.fit.surface = SurfaceKind::cone;
    options.fit.bore = bore;
    const Diagnosis diagnosis = diagnose(stream, options);
    ASSERT_EQ(diagnosis.findings.size(), 1u);
    const Comparison comparison = resimulate(diagnosis, stream).comparison;
    EXPECT_FALSE(refuted(comparison));
    EXPECT_LT(comparison.after.rms_mm, 1.1 * diagnosis.noise.sigma_mm) << "bore " << bore;
  }
}

}  // namespace
}  // namespace trueaxis::testing
