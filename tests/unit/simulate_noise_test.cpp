// SPDX-License-Identifier: Apache-2.0
// Statistics of the noise within five standard errors (a chance of 6e-7 each); seeds are fixed, so
// a pass stays a pass.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr double readings = 40000.0;

Scenario noisy() {
  Scenario scenario;
  scenario.part.radius_mm = 40.0;
  PlannedPass pass;
  pass.revolutions = readings / 10.0;
  scenario.plan.passes = {pass};
  scenario.seed = 11;
  return scenario;
}

struct Moments {
  double mean = 0.0, variance = 0.0, kurtosis = 0.0, lag_one = 0.0;
};

Moments moments_of(const Simulation& out) {
  std::vector<double> e(out.stream.size());
  Moments m;
  const double n = static_cast<double>(e.size());
  for (std::size_t i = 0; i < e.size(); ++i) {
    e[i] = out.stream.reading_mm[i] - out.truth.clean_mm[i];
    m.mean += e[i] / n;
  }
  double fourth = 0.0, product = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double d = e[i] - m.mean;
    m.variance += d * d / n;
    fourth += d * d * d * d / n;
    if (i > 0) product += d * (e[i - 1] - m.mean) / n;
  }
  m.kurtosis = fourth / (m.variance * m.variance);
  m.lag_one = product / m.variance;
  return m;
}

TEST(SimulateNoise, GaussianNoiseHasItsMoments) {
  Scenario scenario = noisy();
  scenario.noise.sigma_mm = 0.01;
  const Moments m = moments_of(simulate_with_truth(scenario));
  const double root = 5.0 / std::sqrt(readings);
  EXPECT_NEAR(m.mean, 0.0, 0.01 * root);
  EXPECT_NEAR(m.variance, 1e-4, 1e-4 * std::sqrt(2.0) * root);
  EXPECT_NEAR(m.kurtosis, 3.0, std::sqrt(24.0) * root);
  EXPECT_NEAR(m.lag_one, 0.0, root);
}

TEST(SimulateNoise, CorrelatedHeavyAndUniformNoiseKeepTheirVariance) {
  Scenario scenario = noisy();
  scenario.noise.sigma_mm = 0.01;
  scenario.noise.rho = 0.8;
  const Moments ar = moments_of(simulate_with_truth(scenario));
  const double root = 5.0 / std::sqrt(readings);
  // Bartlett: variance of r1 is (1 − ρ²)/n, of the sample variance 2σ⁴ (1+ρ²)/(1−ρ²)/n.
  EXPECT_NEAR(ar.lag_one, 0.8, 0.6 * root);
  EXPECT_NEAR(ar.variance, 1e-4, 1e-4 * std::sqrt(2.0 * 1.64 / 0.36) * root);

  scenario.noise.rho = 0.0;
  scenario.noise.student_dof = 10.0;
  const Moments student = moments_of(simulate_with_truth(scenario));
  // Kurtosis of t(10): 3 + 6/(10 − 4) = 4; the variance then errs by √(kurtosis − 1).
  EXPECT_NEAR(student.variance, 1e-4, 1e-4 * std::sqrt(3.0) * root);
  EXPECT_GT(student.kurtosis, 3.0 + std::sqrt(24.0) * root);

  scenario.noise = Noise{};
  scenario.noise.uniform_mm = 0.01;
  const Moments uniform = moments_of(simulate_with_truth(scenario));
  EXPECT_NEAR(uniform.variance, 1e-4 / 3.0, 1e-4 / 3.0 * std::sqrt(0.8) * root);
}

// The correlations follow from Yule and Walker, ρ1 = φ1/(1 − φ2), ρ_k = φ1 ρ_{k−1} + φ2 ρ_{k−2};
// the sample's variance and lag one err as Bartlett says.
TEST(SimulateNoise, AnAutoregressionKeepsItsVarianceAndCorrelation) {
  Scenario scenario = noisy();
  scenario.noise.sigma_mm = 0.01;
  scenario.noise.autoregression = {0.5, 0.3};
  const Moments m = moments_of(simulate_with_truth(scenario));
  std::vector<double> rho{1.0, 0.5 / 0.7};
  for (std::size_t k = 2; k < 400; ++k) rho.push_back(0.5 * rho[k - 1] + 0.3 * rho[k - 2]);
  double squares = 1.0, bartlett = 0.0;
  for (std::size_t k = 1; k + 1 < rho.size(); ++k) {
    squares += 2.0 * rho[k] * rho[k];
    bartlett += std::pow(rho[k + 1] + rho[k - 1] - 2.0 * rho[1] * rho[k], 2);
  }
  const double root = 5.0 / std::sqrt(readings);
  EXPECT_NEAR(m.variance, 1e-4, 1e-4 * std::sqrt(2.0 * squares) * root);
  EXPECT_NEAR(m.lag_one, rho[1], std::sqrt(bartlett) * root);

  scenario.noise.autoregression = {0.8, 0.2};  // a random walk is in it
  EXPECT_THROW(simulate(scenario), InputError);
  scenario.noise.autoregression = {0.5};
  scenario.noise.rho = 0.5;
  EXPECT_THROW(simulate(scenario), InputError);
}

TEST(SimulateNoise, OutliersAreCountedAndOneSided) {
  Scenario scenario = noisy();
  scenario.noise.sigma_mm = 0.001;
  const ProbeStream quiet = simulate(scenario);
  scenario.noise.outlier_fraction = 0.01;
  scenario.noise.outlier_size_mm = 0.1;
  scenario.noise.outliers_one_sided = true;
  const Simulation out = simulate_with_truth(scenario);
  const double expected = 0.01 * static_cast<double>(quiet.size());
  EXPECT_NEAR(static_cast<double>(out.truth.outlier_rows.size()), expected,
              5.0 * std::sqrt(expected));
  const std::set<std::size_t> rows(out.truth.outlier_rows.begin(), out.truth.outlier_rows.end());
  for (std::size_t i = 0; i < quiet.size(); ++i) {
    const double off = out.stream.reading_mm[i] - quiet.reading_mm[i];
    if (rows.contains(i)) {
      EXPECT_GE(off, 0.05 - 1e-12);
      EXPECT_LE(off, 0.15 + 1e-12);
    } else {
      EXPECT_EQ(off, 0.0) << "the Gaussian part must not depend on the outliers";
    }
  }
}

TEST(SimulateNoise, IncidenceWidensIt) {
  Scenario scenario = noisy();
  scenario.part.x0_mm = 20.0;
  scenario.noise.sigma_mm = 0.01;
  const Simulation plain = simulate_with_truth(scenario);
  scenario.noise.incidence = 4.0;
  const Simulation wide = simulate_with_truth(scenario);
  for (std::size_t i = 0; i < 100; ++i) {
    const double sine = 0.5 * std::sin(plain.stream.c_rad[i]);  // of the incidence: (e/R) sin C
    const double tangent2 = sine * sine / (1.0 - sine * sine);
    const double factor = std::sqrt(1.0 + 4.0 * tangent2);
    EXPECT_NEAR(wide.stream.reading_mm[i] - wide.truth.clean_mm[i],
                factor * (plain.stream.reading_mm[i] - plain.truth.clean_mm[i]), 1e-9);
  }
}

TEST(SimulateNoise, SameScenarioSameBitsOtherSeedOtherNoise) {
  Scenario scenario = noisy();
  scenario.noise.sigma_mm = 0.01;
  scenario.noise.rho = 0.3;
  scenario.noise.student_dof = 5.0;
  scenario.plan.passes[0].jitter = 0.3;
  const ProbeStream first = simulate(scenario), second = simulate(scenario);
  EXPECT_EQ(first.reading_mm, second.reading_mm);
  EXPECT_EQ(first.c_rad, second.c_rad);
  scenario.seed = 12;
  EXPECT_NE(first.reading_mm, simulate(scenario).reading_mm);
}

TEST(SimulateNoise, JitterMovesTheInstantsAndKeepsTheirOrder) {
  Scenario scenario = noisy();
  scenario.plan.passes[0].jitter = 0.9;
  const ProbeStream stream = simulate(scenario);
  double least = 1.0, most = 0.0;
  for (std::size_t i = 1; i < stream.size(); ++i) {
    least = std::min(least, stream.time_s[i] - stream.time_s[i - 1]);
    most = std::max(most, stream.time_s[i] - stream.time_s[i - 1]);
    EXPECT_NEAR(stream.c_rad[i], stream.time_s[i] * 2.0 * std::acos(-1.0), 1e-9);
  }
  EXPECT_GT(least, 0.0);  // intervals of 0.1 s ± 0.09 s
  EXPECT_LT(least, 0.03);
  EXPECT_GT(most, 0.17);
}

}  // namespace
}  // namespace trueaxis::virtual_lathe
