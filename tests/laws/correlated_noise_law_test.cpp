// SPDX-License-Identifier: Apache-2.0
// Law: U (k = 2) of every parameter holds the truth as often as it says, whether the noise of the
// readings is white or an autoregression.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <vector>

#include "laws/law_case.hpp"

namespace trueaxis::laws {
namespace {

constexpr int streams = 500;
constexpr std::uint64_t first_seed = 71'000;

struct NoiseCase {
  const char* name;
  double rho;
  std::vector<double> autoregression;
};

LawCase part(std::string_view surface, bool two_passes) {
  LawCase c;
  c.surface = surface;
  c.half_angle_deg = surface == "cone" ? 5.0 : 0.0;
  c.x_mm = 0.03, c.y_mm = -0.02, c.slope_x = 1e-3, c.slope_y = -5e-4;
  c.end_mm = 40.0, c.revolutions = 40.3, c.readings_per_revolution = 24.0;
  c.noise_mm = 0.002, c.returns = two_passes;
  return c;
}

void PrintTo(const NoiseCase& noise, std::ostream* out) { *out << noise.name; }

class CorrelatedNoise : public ::testing::TestWithParam<NoiseCase> {};

// 95.4 % ± 1.5 % is what is asked for; the shares of 500 streams scatter binomially about any share
// within it (1e-4 to either side: 72 shares are looked at).
TEST_P(CorrelatedNoise, IsWithinU) {
  const NoiseCase& noise = GetParam();
  constexpr double level = 1e-4;
  const double least = quantile(boost::math::binomial(streams, 0.9395), level);
  const double most = quantile(boost::math::binomial(streams, 0.9695), 1.0 - level);
  for (const std::string_view surface : {"cone", "cylinder"}) {
    for (const bool two_passes : {false, true}) {
      const LawCase c = part(surface, two_passes);
      const std::vector<double> expected = expected_parameters(c);
      virtual_lathe::Scenario scenario = scenario_of(c);
      scenario.noise.rho = noise.rho;
      scenario.noise.autoregression = noise.autoregression;
      std::map<std::string, int> inside;
      for (int i = 0; i < streams; ++i) {
        scenario.seed = first_seed + static_cast<std::uint64_t>(i);
        const FitResult result = fit(virtual_lathe::simulate(scenario), options_of(c));
        ASSERT_EQ(result.status, FitStatus::converged) << "seed " << scenario.seed;
        const auto count = [&](const FitParameter& parameter, double truth) {
          const Estimate& estimate = parameter.estimate;
          inside[parameter.name] += std::abs(estimate.value - truth) <= 2.0 * estimate.u;
        };
        for (std::size_t j = 0; j < expected.size(); ++j) count(result.parameters[j], expected[j]);
        if (surface != "cone") continue;
        const double secant = std::sqrt(1.0 + c.slope_x * c.slope_x + c.slope_y * c.slope_y);
        const double beyond_mm = (result.shape.axis.z_ref_mm - c.middle_mm()) * secant;
        count({"radius_mid", result.parameter("radius_mid")},
              c.radius_mm + std::tan(c.half_angle_rad()) * beyond_mm);
      }
      EXPECT_EQ(inside.size(), expected.size() + (surface == "cone" ? 1 : 0));
      std::cout << noise.name << ", " << surface << (two_passes ? ", two passes" : ", one pass")
                << ", seeds " << first_seed << " on:";
      for (const auto& [name, hits] : inside) {
        std::cout << ' ' << name << ' ' << 100.0 * hits / streams;
        EXPECT_GE(hits, least) << name;
        EXPECT_LE(hits, most) << name;
      }
      std::cout << '\n';
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, CorrelatedNoise,
                         ::testing::Values(NoiseCase{"White", 0.0, {}},
                                           NoiseCase{"FirstOrder", 0.6, {}},
                                           NoiseCase{"SecondOrder", 0.0, {0.5, 0.3}}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace trueaxis::laws
