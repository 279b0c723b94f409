// SPDX-License-Identifier: Apache-2.0
#include "support/diagnosis_example.hpp"

namespace trueaxis::example {

TermValue fitted(const char* effect, const TermShape& shape, std::vector<double> linear) {
  TermValue term;
  term.effect = find_effect(effect);
  term.shape = shape;
  term.linear = std::move(linear);
  return term;
}

Finding lobes() {
  const double phase = lobes_phase_deg * rad_per_deg;
  Finding finding;
  finding.term = fitted("part.roundness", {.order = 3.0},
                        {lobes_mm * std::cos(phase), lobes_mm * std::sin(phase), 0.0, 0.0});
  finding.rivals = {{"spindle.radial_synchronous", 0.0, -0.3, 0.5, true}};
  finding.parameters = {parameter("order", 3.0, 0.0, "1"),
                        parameter("amplitude", lobes_mm, 1.1e-4, "mm"),
                        parameter("phase", lobes_phase_deg, 1.05, "deg")};
  finding.alias = "order 7, which the sampling folds onto it";
  finding.p_value = 1e-5;
  finding.probability = 0.5;
  finding.rms_mm = lobes_mm / std::sqrt(2.0);
  finding.axis_shift = {5e-5, 2e-5, "mm", ""};
  finding.cosmetic = true;
  finding.separate_with =
      Separating{"RC", "the part re-indexed by 70 deg", 0.5, 0.993, 12.0, "", {}};
  return finding;
}

Finding tilt_motion() {
  Finding finding;
  finding.term = fitted("spindle.tilt_synchronous", {.order = 2.0, .lever_from_mm = -120.0},
                        {1.9e-5, -2e-6, 0.0, 0.0});
  finding.parameters = {parameter("amplitude", 0.0011, 1e-4, "deg")};
  finding.p_value = 0.004;
  finding.probability = 1.0;
  finding.axis_shift = {std::nan(""), std::nan(""), "mm", "the extended axis is not determined"};
  return finding;
}

Unexplained wander() {
  Unexplained pattern;
  pattern.term.pattern = {.order = 7.41, .spindle = true};
  pattern.term.linear = {wander_mm, 0.0};
  pattern.amplitude = {wander_mm, 1e-4, "mm", ""};
  pattern.p_value = 0.002;
  return pattern;
}

NoiseReport noise_report() {
  NoiseReport noise;
  noise.sigma_mm = noise_mm;
  noise.u_sigma_mm = 4e-5;
  noise.source = NoiseSource::revolution_differences;
  noise.note = "no source of its own: a form that repeats is in it";
  noise.autoregression = {0.5};
  noise.revolutions_mm = noise_mm;
  noise.stated_mm = 0.0025;
  noise.masked = {{201, "30 µm off, 15 σ"}, {512, "31 µm off, 15 σ"}};
  noise.gaps = {"C 120 to 145 deg, all along Z"};
  noise.interruptions = {{77, "C 200 to 212 deg: 0.4 mm deep"}};
  return noise;
}

Diagnosis diagnosed(ProbeStream& stream, FitResult& fit) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::unexplained;
  d.named = d.extended = fit;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double c = stream.c_rad[i];
    const double effect = lobes_mm * std::cos(3.0 * c - lobes_phase_deg * rad_per_deg) +
                          wander_mm * std::cos(7.41 * c);
    d.effect_mm.push_back(effect);
    d.residual_after_mm.push_back(fit.residual_mm[i]);
    d.residual_before_mm.push_back(fit.residual_mm[i] + effect);
    stream.reading_mm[i] += effect;
    fit.residual_mm[i] += effect;
  }
  d.baseline = fit;
  d.findings = {lobes(), tilt_motion()};
  d.unexplained = {wander()};
  NotObservable height;
  height.effect = "probe.height";
  height.why = "absorbed by x0, y0 and the radius";
  height.axis_bias_per_unit = {0.005, 0.0, "mm/mm", ""};
  height.detectable = std::numeric_limits<double>::infinity();
  height.detectable_unit = "mm";
  height.separate_with = Separating{"RE", "probed from the rear side", 0.0, 1.0, 15.0, "", {}};
  d.not_observable = {height};
  d.noise = noise_report();
  d.noise.masked = fit.rejected;
  d.checks = {{"probe.saturation", true, "4 readings at 50.1 mm: clipped, left out"},
              {"probe.quantisation", false, ""}};
  d.gain = {{std::hypot(noise_mm, lobes_mm / std::sqrt(2.0)),
             noise_mm,
             {0.0047, 0.0044, 0.005},
             {0.0021, 0.0020, 0.0022},
             {0.447, 0.42, 0.48}},
            "30 blocks of whole revolutions",
            noise_mm,
            {5e-5, 2e-5, "mm", ""},
            {4e-4, 1e-4, "mm", ""},
            {3e-4, 1e-4, "mm", ""}};
  d.next = {"RC",
            "the part re-indexed by 70 deg",
            {"part.roundness", "spindle.radial_synchronous"},
            0.5,
            0.993,
            12.0,
            ""};
  d.plans = {*d.findings.front().separate_with,
             {"2W", "a second speed", 0.5, 0.5, 3.0, "", {}},
             {"ST", "", 0.5, 0.5, 0.0, "the stream has no time column", {}}};
  d.hypotheses = 812;
  d.effective_hypotheses = 640.0;
  d.threshold = 26.3;
  d.z_mid_mm = 15.0;
  d.z_half_mm = 15.0;
  for (int bin = 2; bin <= 60; ++bin) {
    const double order = bin / 4.0;
    const double before = order == 3.0 ? lobes_mm : order == 7.5 ? wander_mm : 1.5e-4;
    d.spectrum.push_back({order, before, 1.5e-4});
  }
  return d;
}

JobResult diagnosed_job(std::size_t readings) {
  JobResult result = cone_job(readings);
  result.diagnoses = {diagnosed(result.streams.front(), result.fits.front())};
  result.resimulations = {std::nullopt};
  return result;
}

JobResult resimulated_job(std::size_t readings) {
  JobResult result = diagnosed_job(readings);
  const ProbeStream& stream = result.streams.front();
  const Diagnosis& d = *result.diagnoses.front();
  Resimulation again;
  std::vector<bool> masked(stream.size(), false);
  for (const Rejected& r : d.noise.masked) masked[r.row - 1] = true;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double clean = stream.reading_mm[i] - d.residual_after_mm[i];
    again.readings.after_mm.push_back(clean);
    again.readings.before_mm.push_back(clean - d.effect_mm[i]);
  }
  again.comparison = compare(stream, again.readings, masked, noise_mm);
  result.resimulations = {again};
  return result;
}

Diagnosis cone_diagnosis(std::size_t readings) {
  return *diagnosed_job(readings).diagnoses.front();
}

}  // namespace trueaxis::example
