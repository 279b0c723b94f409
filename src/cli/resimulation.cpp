// SPDX-License-Identifier: Apache-2.0
#include "cli/resimulation.hpp"

#include "simulate/resimulate.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

Resimulation resimulated(DiagnosedScenarios& scenarios, const ProbeStream& measured) {
  Resimulation out;
  out.readings.before_mm = virtual_lathe::resimulate(scenarios.before, measured, scenarios.masked);
  out.readings.after_mm = virtual_lathe::resimulate(scenarios.after, measured, scenarios.masked);
  const virtual_lathe::Noise& noise = scenarios.after.noise;
  out.comparison =
      compare(measured, out.readings, scenarios.masked, noise.sigma_mm, noise.autoregression);
  return out;
}

std::vector<std::optional<Resimulation>> resimulate_job(const JobResult& result,
                                                        const std::vector<std::string>& diagnoses) {
  std::vector<std::optional<Resimulation>> all(diagnoses.size());
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    if (diagnoses[i].empty()) continue;
    const ProbeStream& stream = result.streams[i];
    try {
      DiagnosedScenarios scenarios = diagnosed_scenarios(
          diagnoses[i], stream.source, stream, result.job.references[i].fit.ball_radius_mm);
      all[i] = resimulated(scenarios, stream);
    } catch (const InputError& error) {  // the job's result does not hang on it
      all[i] = Resimulation{{}, {}, error.diagnostics().front().message};
    }
  }
  return all;
}

}  // namespace trueaxis::cli
