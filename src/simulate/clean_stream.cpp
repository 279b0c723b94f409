// SPDX-License-Identifier: Apache-2.0
#include "simulate/clean_stream.hpp"

#include <algorithm>
#include <cstddef>

#include "simulate/recorder.hpp"
#include "simulate/variates.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {
namespace {

/// Adds σ times a series of standard deviation 1, wider where the incidence is oblique.
template <class Variate>
void add_correlated(const CleanStream& clean, const Noise& noise, Variate variate,
                    std::span<double> reading_mm) {
  Autoregression series(noise);
  for (std::size_t i = 0; i < reading_mm.size(); ++i) {
    const double tangent = noise.incidence > 0.0 ? clean.tan_incidence[i] : 0.0;
    reading_mm[i] += noise.sigma_mm * widening(noise, tangent) * series.next(variate);
  }
}

void add_gaussian_or_student(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                             std::span<double> reading_mm) {
  Xoshiro bits(seed, 1);
  if (!noise.autoregression.empty()) {
    add_correlated(clean, noise, UnitVariates(noise, seed), reading_mm);
  } else if (noise.student_dof > 2.0) {
    const auto student = [&] { return student_variate(bits, noise.student_dof); };
    add_correlated(clean, noise, student, reading_mm);
  } else if (noise.rho == 0.0 && noise.incidence == 0.0) {
    add_normal_variates(bits, noise.sigma_mm, reading_mm);
  } else {
    add_correlated(
        clean, noise, [&] { return normal_variate(bits); }, reading_mm);
  }
}

}  // namespace

CleanStream simulate_clean(const Scenario& scenario) {
  need_one_sensor(scenario);
  validate(scenario.part);
  validate(scenario.noise);
  const std::vector<TimedPass> timeline = make_timeline(scenario.plan);
  const Chain chain = make_chain(scenario.effects);
  const Body body(scenario, chain);
  CleanStream out =
      record_clean(timeline, recording_of(scenario, chain),
                   [&](const Chucking& setup) { return Prober(scenario, chain, body, setup); });
  for (const double value_mm : out.value_mm)
    out.stream.reading_mm.push_back(shown(out.sensor, value_mm).value_mm);
  describe(scenario, out.stream);
  return out;
}

void draw_readings(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                   std::span<double> reading_mm) {
  expects(reading_mm.size() == clean.value_mm.size(), "a place for every reading");
  expects(noise.incidence == 0.0 || !clean.tan_incidence.empty(), "incidence of every reading");
  std::copy(clean.value_mm.begin(), clean.value_mm.end(), reading_mm.begin());
  if (noise.sigma_mm > 0.0) add_gaussian_or_student(clean, noise, seed, reading_mm);
  if (noise.uniform_mm > 0.0) {
    Xoshiro bits(seed, 2);
    for (double& reading : reading_mm) reading += noise.uniform_mm * (2.0 * bits.uniform() - 1.0);
  }
  if (noise.outlier_fraction > 0.0) {
    Xoshiro bits(seed, 3);
    for (std::size_t i = 0; i < reading_mm.size(); ++i)
      reading_mm[i] +=
          draw_outlier(noise, clean.away[i], [&] { return bits.uniform(); }).value_or(0.0);
  }
  if (clean.sensor == SensorLimits{}) return;
  for (double& reading : reading_mm) reading = shown(clean.sensor, reading).value_mm;
}

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
