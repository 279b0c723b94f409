// SPDX-License-Identifier: Apache-2.0
// Whole diagnoses of streams of the virtual lathe: false alarms on white noise, and coverage of U
// of what a finding says.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>

#include "diagnose/files/diagnosis_text.hpp"
#include "support/diagnose_lathe.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::uint64_t seed = 31000;
constexpr int streams = 200;
constexpr double sigma_mm = 0.01;

// At 1 % a stream the count exceeds the limit with probability 1e-4 (7 of 200).
TEST(DiagnoseWhiteNoise, AlarmsAtItsLevel) {
  std::cout << "seeds " << seed << " …, " << streams << " streams\n";
  virtual_lathe::Scenario scenario = testing::one_pass(0.1, 20.0, sigma_mm);
  DiagnoseOptions options = testing::on_one_core(scenario);
  options.false_alarm = 0.01;
  int alarms = 0;
  for (int s = 0; s < streams; ++s) {
    scenario.seed = seed + static_cast<std::uint64_t>(s);
    const Diagnosis found = diagnose(virtual_lathe::simulate(scenario), options);
    if (found.verdict == DiagnosisVerdict::ideal) continue;
    ++alarms;
    std::cout << "seed " << scenario.seed << ": "
              << (found.findings.empty() ? harmonic_text(found.unexplained[0].term.pattern)
                                         : found.findings[0].effect())
              << '\n';
  }
  const boost::math::binomial hits(streams, options.false_alarm);
  EXPECT_LE(alarms, quantile(complement(hits, 1e-4)));
  // Silence is not a level: lobes of λ = N a²/(2σ²) above 100 are missed in one stream of 1e8.
  constexpr int with_lobes = 20;
  scenario.effects = {{"part.roundness", {{"order", 3}, {"amplitude_mm", sigma_mm}}}};
  int seen = 0;
  for (int s = 0; s < with_lobes; ++s) {
    scenario.seed = seed + static_cast<std::uint64_t>(s);
    const ProbeStream stream = virtual_lathe::simulate(scenario);
    ASSERT_GT(static_cast<double>(stream.size()) / 2.0, 100.0);
    seen += diagnose(stream, options).verdict != DiagnosisVerdict::ideal;
  }
  EXPECT_EQ(seen, with_lobes);
}

constexpr double turns = 12.3, lead_mm = 60.0 / turns, readings_per_turn = 23.7;

/// A line's frequency in Hz, from the parameter of whatever it is named: in one pass at 60 rpm
/// along a cylinder t, C and Z are one variable.
std::optional<Estimate> hertz_of(const Finding& finding) {
  const auto scaled = [&](const char* name, auto to_hz) -> std::optional<Estimate> {
    const Estimate* e = testing::parameter_of(finding, name);
    if (!e) return std::nullopt;
    const double step = 1e-6 * e->value;
    const double slope = (to_hz(e->value + step) - to_hz(e->value - step)) / (2.0 * step);
    return Estimate{to_hz(e->value), std::abs(slope) * e->u, "Hz", ""};
  };
  if (finding.effect() == "environment.vibration")
    return scaled("frequency", [](double f) { return f; });
  if (finding.effect() == "spindle.asynchronous")
    return scaled("order", [](double k) { return k; });
  if (finding.effect() == "part.waviness")
    return scaled("wavelength", [](double mm) { return lead_mm / mm; });
  if (finding.effect() == "part.feed_marks")
    return scaled("feed", [](double mm) { return lead_mm / mm - 1.0; });
  return std::nullopt;
}

// Three lobes and a line of 3.3 Hz, each of λ = N a²/(2σ²) near 100: they are found in nearly every
// stream (power 1 − 1e-8 at a statistic of 28). U = 2 u of amplitude, phase and frequency holds the
// truth as often as Student's t says. A form is a synchronous motion in one chucking: any of the
// twins' names will do.
TEST(DiagnoseEffects, UCovers) {
  std::cout << "seeds " << seed << " …, " << streams << " streams\n";
  constexpr double amplitude_mm = 8e-3, phase_rad = 0.7, line_hz = 3.3;
  virtual_lathe::Scenario scenario = testing::one_pass(0.0, turns, sigma_mm);
  scenario.effects = {
      {"part.roundness", {{"order", 3}, {"amplitude_mm", amplitude_mm}, {"phase_rad", phase_rad}}},
      {"environment.vibration",
       {{"amplitude_mm", amplitude_mm}, {"frequency_hz", line_hz}, {"phase_rad", 0.3}}}};
  DiagnoseOptions options = testing::on_one_core(scenario);
  options.max_findings = 3;
  std::map<std::string, int> covered, asked, names;
  const auto ask = [&](const char* what, const Estimate* e, double truth) {
    if (!e) return;
    ++asked[what];
    const double off =
        e->unit == "rad" ? std::remainder(e->value - truth, two_pi) : e->value - truth;
    covered[what] += std::abs(off) <= 2.0 * e->u;
  };
  for (int s = 0; s < streams; ++s) {
    scenario.seed = seed + static_cast<std::uint64_t>(s);
    const Diagnosis found = diagnose(virtual_lathe::simulate(scenario), options);
    for (const Finding& f : found.findings) {
      ++names[f.effect()];
      const Estimate* order = testing::parameter_of(f, "order");
      if ((f.effect() == "part.roundness" || f.effect() == "spindle.radial_synchronous") && order &&
          order->value == 3.0) {
        ask("amplitude", testing::parameter_of(f, "amplitude"), amplitude_mm);
        ask("phase", testing::parameter_of(f, "phase"), phase_rad);
      }
      const std::optional<Estimate> frequency = hertz_of(f);
      if (frequency && std::abs(frequency->value - line_hz) < 0.5 / turns)
        ask("frequency", &*frequency, line_hz);
    }
    for (const Unexplained& u : found.unexplained)
      ++names[harmonic_text(u.term.pattern) + ' ' + dependence_text(u.term.pattern)];
  }
  for (const auto& [name, count] : names) std::cout << count << " x " << name << '\n';
  const boost::math::students_t student(turns * readings_per_turn - 10.0);
  const double level = 1.0 - 2.0 * cdf(complement(student, 2.0));
  for (const char* what : {"amplitude", "phase", "frequency"}) {
    const int n = asked[what];
    std::cout << what << ": U holds the truth in " << covered[what] << " of " << n << '\n';
    EXPECT_GT(n, 4 * streams / 5) << what;  // others bear names with another amplitude
    const boost::math::binomial hits(n, level);
    EXPECT_GE(covered[what], quantile(hits, 1e-4)) << what;
    EXPECT_LE(covered[what], quantile(complement(hits, 1e-4))) << what;
  }
}

}  // namespace
}  // namespace trueaxis
