// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

/// A cylinder of the virtual lathe that hides one effect, and what measured minus simulated must
/// then be before and after it is found.
namespace trueaxis::testing {

struct HiddenEffect {
  std::string effect = "id = \"part.roundness\"\norder = 3\namplitude_um = 4\nphase_deg = 40\n";
  std::string probe;
  double amplitude_mm = 0.004, sigma_mm = 0.002;
  double mean_square = 0.5;  ///< of the effect at amplitude 1
  double readings = 1669.0;  ///< 40 turns of 41.7, and the last
  double uneven_mm = 1e-4;   ///< the 70 µm of eccentricity over turns that are not whole: less
  int seed = 20261121;

  std::string scenario() const {
    return "seed = " + std::to_string(seed) +
           "\n[part]\nkind = \"cylinder\"\nradius_mm = 40\nx0_mm = 0.05\nl = 0.0002\n[noise]\n"
           "sigma_um = 2\n[[pass]]\nz_start_mm = 0\nz_end_mm = 40\nfeed_mm_per_rev = 1\n"
           "readings_per_revolution = 41.7\n" +
           probe + "[[effect]]\n" + effect;
  }
  double variance_mm2() const { return amplitude_mm * amplitude_mm * mean_square; }
};

/// Of trueaxis.comparison/2, or of what result.json says. The seed is in the scenario.
inline void expect_effect_taken_out(const nlohmann::json& comparison, const HiddenEffect& hidden) {
  const auto of = [&](const char* which, const char* key) -> const nlohmann::json& {
    return comparison.at(which).at(key);
  };
  const auto mean_square = [&](const char* which) {
    return std::pow(of(which, "rms").at("value").get<double>(), 2);
  };
  const double n = hidden.readings, noise = std::pow(hidden.sigma_mm, 2);
  const double effect = hidden.variance_mm2(), parameters = 10.0;  // fitted, at most
  const double before = mean_square("before"), after = mean_square("after");
  // Five standard errors of a mean of squares of noise, √(2/n) σ², and of noise times effect.
  const double noise_spread = 5.0 * std::sqrt(2.0 / n) * noise + parameters / n * noise;
  const double cross = 5.0 * 2.0 * std::sqrt(effect * noise / n);
  // The turns are not whole: 1/n of the effect each.
  const double uneven = parameters / n * effect;
  EXPECT_NEAR(before, effect + noise, noise_spread + cross + uneven) << hidden.scenario();
  EXPECT_NEAR(after, noise, noise_spread + uneven) << hidden.scenario();
  EXPECT_NEAR(before - after, effect, cross + 5.0 * parameters / n * noise + uneven)
      << hidden.scenario();
  EXPECT_NEAR(of("before", "share_of_variance").get<double>(), 1.0, 1e-12);
  const double share = noise / (effect + noise);
  EXPECT_NEAR(of("after", "share_of_variance").get<double>(), share,
              (noise_spread + cross + uneven) / (effect + noise));
  EXPECT_EQ(comparison.at("readings"), hidden.readings);
  EXPECT_EQ(comparison.at("masked"), 0);
}

/// A column of a CSV text by the name in its header.
inline std::vector<double> column(const std::string& csv, const std::string& name) {
  std::istringstream lines(csv);
  std::vector<double> values;
  constexpr std::size_t nowhere = 1000;
  std::size_t place = nowhere;
  bool headed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::size_t at = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++at) {
      if (!headed && cell == name) place = at;
      if (headed && at == place) values.push_back(std::stod(cell));
    }
    headed = true;
  }
  EXPECT_NE(place, nowhere) << name;
  return values;
}

}  // namespace trueaxis::testing
