// SPDX-License-Identifier: Apache-2.0
// U of form: it holds the truth, it is the same on any number of threads, and it says its bias.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "form/section_model.hpp"
#include "form/uncertainty.hpp"
#include "support/form_profiles.hpp"

namespace trueaxis::testing {
namespace {

constexpr double noise_mm = 0.5e-3;

ProbeStream noisy(double lobes_mm, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_mm);
  return section_stream(
      [&](double t) { return 20.0 + lobes_mm * std::cos(3.0 * t) + noise(random); }, 720);
}

FormOptions with_u() {
  FormOptions options = quick(ProfileFilter::gaussian, 15.0);
  options.trials = 60;
  return options;
}

// U (k = 2, 95 %) must hold the truth of a lobed part in at least 86 of 100 profiles: binomial of
// 0.95, four σ below. The same holds for a round part, which noise alone makes out of round.
TEST(FormUncertainty, HoldsTheTruth) {
  const double passed = std::exp2(-(3.0 / 15.0) * (3.0 / 15.0));
  for (const double lobes_mm : {0.0, 0.3e-3, 3e-3}) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const FormValue value =
          value_of(assess_form(noisy(lobes_mm, seed), with_u()).sections[0].values, "RONt", "MZCI");
      held += std::abs(value.estimate.value - 2.0 * passed * lobes_mm) <= 2.0 * value.estimate.u;
      EXPECT_GT(value.estimate.u, 0.0);
    }
    EXPECT_GE(held, 86) << "lobes of " << lobes_mm << " mm";
  }
}

// The noise of one reading is found to 15 % from 720 of them: σ √(2.5/720) of a median, three σ.
TEST(FormUncertainty, FindsTheNoise) {
  const SectionForm section = assess_form(noisy(3e-3, 4), with_u()).sections[0];
  EXPECT_NEAR(section.noise_mm, noise_mm, 0.18 * noise_mm);
  // u of an order: σ √(2/N).
  EXPECT_NEAR(section.harmonics[4].u_mm, section.noise_mm * std::sqrt(2.0 / 720.0), 1e-12);
}

// Of a round part RONt is noise alone; the stated bias is most of it.
TEST(FormUncertainty, SaysTheBiasOfARange) {
  double value = 0.0, bias = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FormValue one =
        value_of(assess_form(noisy(0.0, seed), with_u()).sections[0].values, "RONt", "LSCI");
    value += one.estimate.value;
    bias += one.bias_mm;
  }
  EXPECT_GT(bias, 0.6 * value);
  EXPECT_LT(bias, 1.1 * value);
}

TEST(FormUncertainty, SameOnAnyNumberOfThreads) {
  const ProbeStream stream = noisy(1e-3, 9);
  FormOptions options = with_u();
  options.threads = 1;
  const FormResult one = assess_form(stream, options);
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    const FormResult more = assess_form(stream, options);
    for (std::size_t v = 0; v < one.sections[0].values.size(); ++v) {
      EXPECT_EQ(one.sections[0].values[v].estimate.u, more.sections[0].values[v].estimate.u);
      EXPECT_EQ(one.sections[0].values[v].bias_mm, more.sections[0].values[v].bias_mm);
    }
  }
}

// A known motion is subtracted; one known by its range alone widens U to that size.
TEST(FormUncertainty, TheSpindlesMotion) {
  const double motion = 1e-3;
  const ProbeStream stream = section_stream(
      [&](double t) { return 20.0 + 2e-3 * std::cos(3.0 * t) + motion * std::sin(2.0 * t); }, 720);
  FormOptions options = with_u();
  options.spindle = {{2, 0.0, motion, 0.05e-3}};
  const double passed = std::exp2(-(3.0 / 15.0) * (3.0 / 15.0));
  const FormValue known = value_of(assess_form(stream, options).sections[0].values, "RONt", "MZCI");
  EXPECT_NEAR(known.estimate.value, 4e-3 * passed, 1e-9);
  EXPECT_GT(known.estimate.u, 0.02e-3);
  options.spindle.clear();
  options.spindle_range_mm = motion;
  const FormValue range = value_of(assess_form(stream, options).sections[0].values, "RONt", "MZCI");
  EXPECT_GT(range.estimate.u, 0.2 * motion);
}

// Eq. 269: a ball of 5 mm on R = 10 follows 100 lobes of 3 µm; of 30 µm it bridges the valleys.
TEST(FormUncertainty, WhatABallTouches) {
  form::Trace trace;
  trace.period = two_pi;
  std::vector<double> small, large;
  const double order = 100.0, radius = 10.0, ball = 5.0;
  for (int i = 0; i < 7200; ++i) {
    trace.at.push_back(two_pi * i / 7200.0);
    small.push_back(1e-3 * std::cos(order * trace.at.back()));
  }
  trace.value_mm = small;
  // r̂ of a smooth trace is r − r′²/2κ; at hills and valleys nothing changes.
  const auto touched = form::touched_by_ball(trace, small, radius, ball, false);
  const double bend = radius * radius / ball + radius;
  for (int i = 0; i < 7200; i += 7) {
    const auto at = static_cast<std::size_t>(i);
    const double slope = -1e-3 * order * std::sin(order * trace.at[at]);
    // second order in slope over bend, and the steps of the trace
    EXPECT_NEAR(touched[at], small[at] - 0.5 * slope * slope / bend, 0.6e-4);
    EXPECT_LE(touched[at], small[at]);
  }
  EXPECT_NEAR(touched[36], small[36], 1e-12);
}

}  // namespace
}  // namespace trueaxis::testing
