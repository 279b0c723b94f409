// SPDX-License-Identifier: Apache-2.0
// Profile filters against their transfer functions, which are written here in other words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "form/low_pass.hpp"
#include "form/regression_rows.hpp"
#include "form/sampling.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

Trace turn_of(std::size_t n, double jitter = 0.0) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> by(-jitter, jitter);
  Trace trace;
  trace.period = two_pi;
  for (std::size_t i = 0; i < n; ++i)
    trace.at.push_back(two_pi * (static_cast<double>(i) + 0.5 + by(random)) /
                       static_cast<double>(n));
  trace.value_mm.assign(n, 0.0);
  return trace;
}

/// The largest that a filtered wave is off `transmission` times the wave.
double off_transmission(const Trace& trace, const LowPass& filter, double order,
                        double transmission) {
  std::vector<double> wave;
  for (const double at : trace.at) wave.push_back(std::cos(order * at - 0.3));
  const std::vector<double> passed = filter(wave);
  double off = 0.0;
  for (std::size_t i = 0; i < wave.size(); ++i)
    off = std::max(off, std::abs(passed[i] - transmission * wave[i]));
  return off;
}

// ISO 16610-21: 2^−(f/fc)². 1e-6: the kernel is cut off at 2.5e-7 of its height.
TEST(FormFilter, GaussianHasItsTransferFunctionAtEveryStandardCutOff) {
  for (const double cutoff : {15.0, 50.0, 150.0, 500.0}) {
    const Trace trace = turn_of(3600);
    const auto filter = gaussian_low_pass(trace, two_pi / cutoff);
    for (const double order : {std::floor(cutoff / 2), cutoff, std::floor(1.5 * cutoff)}) {
      const double transmission = std::exp2(-(order / cutoff) * (order / cutoff));
      EXPECT_LT(off_transmission(trace, *filter, order, transmission), 1e-6) << cutoff << order;
    }
  }
}

// The trapezoidal rule over a jitter of a fifth of a step, 72 readings a wave.
TEST(FormFilter, UnevenAnglesAreTakenAsTheyAre) {
  const Trace trace = turn_of(3600, 0.2);
  const auto gaussian = gaussian_low_pass(trace, two_pi / 50.0);
  EXPECT_LT(off_transmission(trace, *gaussian, 50.0, 0.5), 1e-4);
  EXPECT_NEAR(measured_transmission(trace, *gaussian, two_pi / 50.0), 0.5, 1e-5);
  // Were they taken as even, the wave's own phase would be off by up to 50 · 0.2 steps.
  EXPECT_GT(50.0 * 0.2 * two_pi / 3600.0, 1e-2);
}

// A density that changes by 3 over the turn: the first moment is kept.
TEST(FormFilter, ASpeedThatSwingsChangesNothing) {
  Trace trace = turn_of(3600);
  for (double& at : trace.at) at += 0.5 * std::sin(at);
  const auto filter = gaussian_low_pass(trace, two_pi / 15.0);
  EXPECT_LT(off_transmission(trace, *filter, 15.0, 0.5), 1e-4);
}

TEST(FormFilter, SplineHasItsTransferFunction) {
  for (const double cutoff : {15.0, 150.0, 500.0}) {
    const Trace trace = turn_of(3600);
    const auto filter = spline_low_pass(trace, two_pi / cutoff);
    for (const double order : {std::floor(cutoff / 2), cutoff, std::floor(1.5 * cutoff)}) {
      const double step = two_pi / 3600.0;
      const double ratio = std::sin(order * step / 2) / std::sin(cutoff * step / 2);
      // 1e-8: rounding of a matrix whose condition number is (3600/15)⁴.
      EXPECT_LT(off_transmission(trace, *filter, order, 1.0 / (1.0 + std::pow(ratio, 4))), 1e-8);
    }
  }
}

// (1 + u) e^−u at the cut-off is a half: γ = 0.7309 of ISO 16610-31.
TEST(FormFilter, RegressionOfSecondDegreeHasItsTransferFunction) {
  const Trace trace = turn_of(3600);
  const RegressionRows rows(trace, {0.7309134280946759 * two_pi / 50.0, 2}, shares_of(trace, 1.0));
  EXPECT_LT(off_transmission(trace, rows, 50.0, 0.5), 1e-5);  // the kernel's cut, times d⁴
  EXPECT_NEAR(robust_transmission(1.0, 1.0), 0.5, 1e-12);
}

TEST(FormFilter, ARobustFilterPassesOverSpikesThatAGaussianSmears) {
  Trace trace = turn_of(3600);
  for (std::size_t i = 0; i < trace.size(); ++i)
    trace.value_mm[i] = 1e-3 * std::cos(3.0 * trace.at[i]);
  const std::vector<double> clean = trace.value_mm;
  for (std::size_t i = 0; i < trace.size(); i += 200) trace.value_mm[i] += 20e-3;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 1e-5);
  for (double& one : trace.value_mm) one += noise(random);
  const auto robust = (*robust_low_pass(trace, two_pi / 15.0))(trace.value_mm);
  const auto plain = (*gaussian_low_pass(trace, two_pi / 15.0))(trace.value_mm);
  double off_robust = 0.0, off_plain = 0.0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    off_robust = std::max(off_robust, std::abs(robust[i] - clean[i]));
    off_plain = std::max(off_plain, std::abs(plain[i] - clean[i]));
  }
  // Noise passes with σ √(2·15·1.2/3600) = 1e-6 mm, 5 σ; order 3 of 15 loses (u²/2 = 0.0023).
  EXPECT_LT(off_robust, 5e-6 + 0.0025e-3);
  EXPECT_GT(off_plain, 50e-6);
}

// A straight line is kept up to its ends and to the edges of a gap by all three: rounding.
TEST(FormFilter, EndsAndGapsKeepALine) {
  Trace trace;
  for (int i = 0; i < 400; ++i)
    if (i < 150 || i > 220) trace.at.push_back(0.1 * i);
  for (const double at : trace.at) trace.value_mm.push_back(0.02 + 3e-3 * at);
  for (const auto& filter :
       {gaussian_low_pass(trace, 2.5), robust_low_pass(trace, 2.5), spline_low_pass(trace, 2.5)}) {
    const std::vector<double> passed = (*filter)(trace.value_mm);
    for (std::size_t i = 0; i < trace.size(); ++i)
      EXPECT_NEAR(passed[i], trace.value_mm[i], 1e-10) << trace.at[i];
  }
}

// What lies beyond a gap of seven waves does not reach across it.
TEST(FormFilter, NothingReachesAcrossAGap) {
  Trace trace;
  for (int i = 0; i < 400; ++i)
    if (i < 150 || i > 220) trace.at.push_back(0.1 * i);
  trace.value_mm.assign(trace.size(), 0.0);
  for (std::size_t i = 150; i < trace.size(); ++i) trace.value_mm[i] = 1.0;
  for (const auto& filter : {gaussian_low_pass(trace, 1.0), spline_low_pass(trace, 1.0)})
    EXPECT_LT(std::abs((*filter)(trace.value_mm)[149]), 1e-9);
  ASSERT_EQ(gaps_of(trace, longest_step(1.0)).size(), 1U);
}

// 720 angles less five slots are not "18 readings per revolution", and more of them do not help.
TEST(FormFilter, SlotsOfMoreThanAQuarterOfTheTurnAreNamed) {
  const auto trouble_with = [](double slot_deg) {
    Trace trace = turn_of(720);
    std::erase_if(trace.at, [&](double at) {
      return std::abs(std::remainder(at, two_pi / 5.0)) < 0.5 * slot_deg * rad_per_deg;
    });
    trace.value_mm.assign(trace.at.size(), 0.0);
    return sampling_trouble(trace, {});
  };
  EXPECT_EQ(trouble_with(17.0), "");
  EXPECT_NE(trouble_with(20.0).find("° of the turn without a reading"), std::string::npos)
      << trouble_with(20.0);
  EXPECT_NE(sampling_trouble(turn_of(100), {}).find("and there are 100"), std::string::npos);
}

// Three turns of 37.21 readings each: 111 angles, as many as 15 UPR need, 2.0° to 7.6° apart. Half
// a wave of 15 UPR is 12°, so none of the steps is a gap. They do support what the message says.
TEST(FormFilter, UnevenAnglesAreNoGap) {
  Trace trace = turn_of(111);
  for (int i = 0; i < 111; ++i)
    trace.at[static_cast<std::size_t>(i)] = std::fmod(i * two_pi / 37.21, two_pi);
  std::ranges::sort(trace.at);
  FormOptions options;
  options.high_upr = 15.0;
  const std::string trouble = sampling_trouble(trace, options);
  ASSERT_EQ(trouble.find("without a reading"), std::string::npos) << trouble;
  const std::size_t at = trouble.find("they support up to ");
  ASSERT_NE(at, std::string::npos) << trouble;
  options.high_upr = std::stod(trouble.substr(at + 19));
  EXPECT_EQ(sampling_trouble(trace, options), "");
}

}  // namespace
}  // namespace trueaxis::form
