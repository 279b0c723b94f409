// SPDX-License-Identifier: Apache-2.0
// The whole job from arrays: a seat is probed, and a shoulder next to it is to be cut true to it.
#include <cstdio>
#include <trueaxis/trueaxis.hpp>

using namespace trueaxis;

int main() {
  virtual_lathe::Scenario scenario;  // in place of your probe: a seat 80 µm off and tilted
  scenario.part.radius_mm = 20.0;
  scenario.part.x0_mm = 0.08, scenario.part.l = 3e-4;
  virtual_lathe::PlannedPass pass;
  pass.end_mm = 40.0, pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = 24.0;
  scenario.plan.passes = {pass};
  scenario.noise.sigma_mm = 5e-4;

  Job job;
  job.references.resize(1);
  job.references[0].name = "seat";
  job.references[0].fit.surface = SurfaceKind::cylinder;
  TargetSurface target;
  target.z_start_mm = 60.0, target.z_end_mm = 50.0, target.radius_mm = 24.0;
  job.target = target;
  job.coaxiality_tolerance_mm = 0.005;
  job.tool.speed_rpm = 600.0, job.tool.nose_radius_mm = 0.4;

  const JobResult result = run_job(job, {virtual_lathe::simulate(scenario)});
  std::printf("%s:", to_string(result.verdict.decision));
  for (const Reason& reason : result.verdict.reasons) std::printf(" %s", to_string(reason.code));
  std::printf(", coaxiality at most %.1f µm\n", 1e3 * result.verdict.upper_mm);
  const CorrectionRows& rows = result.correction->rows;
  std::printf("revolution   Z mm     C rad    command µm\n");
  for (std::size_t i = 0; i < rows.c_rad.size(); i += rows.c_rad.size() / 8)
    std::printf("%10d %8.3f %9.3f %10.2f\n", rows.revolution[i], rows.position_mm[i], rows.c_rad[i],
                1e3 * rows.command_mm[i]);
  return result.verdict.go() ? 0 : 1;
}
