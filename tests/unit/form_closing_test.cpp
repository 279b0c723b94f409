// SPDX-License-Identifier: Apache-2.0
// A trace of one revolution whose end is not its beginning: what drifted is found, and in U.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "form/closing.hpp"
#include "support/form_profiles.hpp"

namespace trueaxis::testing {
namespace {

constexpr double nominal_mm = 20.0, sigma_mm = 2e-4;

double drifting_shape_mm(double t) {
  return nominal_mm + 2e-3 * std::cos(2.0 * t - 0.4) + 1e-3 * std::cos(7.0 * t) +
         3e-3 * std::cos(t - 1.0);
}

/// 720 readings per revolution with noise, drifting by so much over the revolution: steadily, or
/// settling.
ProbeStream drifting(double turns, double drift_mm, bool settles, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  ProbeStream stream;
  for (int i = 0; i < 720.0 * turns; ++i) {
    const double part = i / 720.0, c = two_pi * part;
    const double drifted = settles ? (1.0 - std::exp(-2.0 * part)) / (1.0 - std::exp(-2.0)) : part;
    stream.c_rad.push_back(c);
    stream.reading_mm.push_back(drifting_shape_mm(c) + drift_mm * drifted + noise(engine));
  }
  return stream;
}

bool says_so(const FormResult& result) {
  return std::ranges::any_of(result.notes, [](const std::string& note) {
    return note.find("does not close") != std::string::npos;
  });
}

// The true values are those of the part alone: the range of its lobes and its eccentricity.
TEST(FormClosing, ADriftOfARevolutionIsInU) {
  double high = -1.0, low = 1.0;
  for (int k = 0; k < 7200; ++k) {
    const double t = two_pi * k / 7200.0;
    const double lobes = drifting_shape_mm(t) - nominal_mm - 3e-3 * std::cos(t - 1.0);
    high = std::max(high, lobes), low = std::min(low, lobes);
  }
  for (const double turns : {1.0, 1.03})
    for (const double drift_mm : {0.02, -0.004})
      for (const bool settles : {false, true}) {
        const ProbeStream stream = drifting(turns, drift_mm, settles, 3);
        const FormResult result = assess_form(stream, quick());
        EXPECT_TRUE(says_so(result));
        const SectionForm& section = result.sections.front();
        for (const auto& [name, truth] :
             {std::pair{"RONt", high - low}, {"eccentricity", 3e-3}, {"radius", nominal_mm}}) {
          const FormValue& value = value_of(section.values, name, "LSCI");
          const double k = result.options.coverage_factor;
          EXPECT_LE(least_of(value, k), truth) << name << drift_mm << settles << turns;
          EXPECT_GE(most_of(value, k), truth) << name << drift_mm << settles << turns;
        }
      }
}

// Three standard deviations of normal noise: 0.27 % of traces that close, 4 of 400 in 0.1 % of
// tests. u is estimated from 48 neighbours of one another: 3 are then 0.6 %, and 7 of 400.
TEST(FormClosing, FindsTheStepAndNoneInNoise) {
  int alarms = 0;
  double off = 0.0;
  constexpr int repeats = 400;
  for (unsigned seed = 0; seed < repeats; ++seed) {
    alarms += says_so(assess_form(drifting(1.0, 0.0, false, seed), quick())) ? 1 : 0;
    form::SectionReadings readings;
    const ProbeStream stream = drifting(1.0, 0.002, false, seed + 1000);
    readings.angle_rad = stream.c_rad, readings.distance_mm = stream.reading_mm;
    const auto closing = form::closing_of(readings, 50.0);
    ASSERT_TRUE(closing.has_value());
    off += std::pow((closing->step_mm - 0.002) / closing->u_mm, 2) / repeats;
  }
  std::cout << alarms << " alarms, deviations " << std::sqrt(off) << " u\n";
  EXPECT_LE(alarms, 7);
  EXPECT_NEAR(std::sqrt(off), 1.0, 0.15);  // of 400 by 3.5 %, and form within the lines
}

}  // namespace
}  // namespace trueaxis::testing
