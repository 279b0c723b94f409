// SPDX-License-Identifier: Apache-2.0
// A shaft whose seat has five lobes is diagnosed: what does the ideal cylinder miss?
#include <cstdio>
#include <trueaxis/trueaxis.hpp>

using namespace trueaxis;

int main() {
  virtual_lathe::Scenario scenario;  // two passes over 60 mm of a shaft, noise of 1 µm
  scenario.part.radius_mm = 20.0;
  scenario.part.x0_mm = 0.1;
  for (const double speed_rpm : {60.0, 90.0}) {
    virtual_lathe::PlannedPass pass;
    pass.end_mm = 60.0, pass.feed_mm_per_rev = 1.5, pass.speed_rpm = speed_rpm;
    pass.readings_per_revolution = 23.7;
    scenario.plan.passes.push_back(pass);
  }
  scenario.noise.sigma_mm = 1e-3;
  scenario.effects = {{"part.roundness", {{"order", 5.0}, {"amplitude_mm", 4e-3}}}};

  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cylinder;
  const Diagnosis diagnosis = diagnose(virtual_lathe::simulate(scenario), options);
  std::printf("%s, noise %.2f µm\n", to_string(diagnosis.verdict), 1e3 * diagnosis.noise.sigma_mm);
  for (const Finding& finding : diagnosis.findings) {
    std::printf("%s, p %.1e; explained as well by:", finding.effect().c_str(), finding.p_value);
    for (const std::string& member : finding.members())
      if (member != finding.effect()) std::printf(" %s", member.c_str());
    std::printf("\n");
    for (const auto& [name, estimate] : finding.parameters)
      std::printf("  %-12s %.5g ± %.2g %s\n", name.c_str(), estimate.value, 2 * estimate.u,
                  estimate.unit.c_str());
  }
  return diagnosis.verdict == DiagnosisVerdict::effects ? 0 : 1;
}
