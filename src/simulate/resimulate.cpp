// SPDX-License-Identifier: Apache-2.0
#include "simulate/resimulate.hpp"

#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

std::vector<double> resimulate(Scenario& scenario, const ProbeStream& measured,
                               const std::vector<bool>& masked) {
  expects(masked.size() == measured.size(), "a mark for every reading");
  Scenario clean = scenario;
  clean.noise = Noise{};
  if (measured.indication == Indication::relative) clean.probe.relative_zero_mm = 0.0;
  std::vector<double> readings = simulate_at(clean, measured).truth.clean_mm;
  if (measured.indication == Indication::absolute) return readings;
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (masked[i]) continue;
    sum += readings[i] - measured.reading_mm[i];
    count += 1.0;
  }
  const double zero_mm = count > 0.0 ? sum / count : 0.0;
  for (double& reading : readings) reading -= zero_mm;
  scenario.probe.relative_zero_mm = zero_mm;
  return readings;
}

}  // namespace trueaxis::virtual_lathe
