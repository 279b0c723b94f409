// SPDX-License-Identifier: Apache-2.0
// Law: what readings of a spindle do not show is in U or refused: orders that fold because a turn
// has few readings, angles that nobody stated with an uncertainty, set-ups that contradict.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laws/spindle_bench.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/spindle.hpp"

namespace trueaxis::laws {
namespace {

double range_mm(const TrueSeries& series) {
  double low = 1.0, high = -1.0;
  for (int i = 0; i < 3600; ++i) {
    double at = 0.0;
    for (std::size_t n = 2; n < series.size(); ++n)
      at += (series[n] * std::polar(1.0, two_pi * static_cast<double>(n) * i / 3600.0)).real();
    low = std::min(low, at), high = std::max(high, at);
  }
  return high - low;
}

bool noted(const SpindleResult& result, const char* words) {
  return std::ranges::any_of(
      result.notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

/// Three sensors, form and motion to order 30.
SpindleBench three_sensors(std::uint64_t seed, double per_turn) {
  SpindleBench bench(seed, 30);
  bench.sensors_deg({0, 55, 113.2});
  bench.passes({1}, 12.0, per_turn);
  bench.scenario.noise.sigma_mm = 20e-6;
  return bench;
}

// 50 readings per revolution: orders 26 to 30 read like 24 to 20.
TEST(SpindleDoubtsLaw, WhatFoldsIsInUAndTheTotalHoldsWhatRepeats) {
  int inside = 0;
  constexpr int seeds = 12;
  for (int seed = 1; seed <= seeds; ++seed) {
    const SpindleBench bench = three_sensors(static_cast<std::uint64_t>(seed), 50.0);
    const SpindleResult result = bench.separate();
    EXPECT_TRUE(noted(result, "may fold into every order")) << seed;
    const MotionValues& values = result.radial->sensitive;
    inside +=
        std::abs(values.synchronous.value - range_mm(bench.along_x)) <= 2.0 * values.synchronous.u;
    for (const MotionValues* one : {&values, &result.radial->across})
      EXPECT_GE(one->total.value, one->synchronous.value) << seed;
  }
  EXPECT_GE(inside, 10) << "of " << seeds;  // 95 %: 9 and fewer in 0.2 % of cases
}

TEST(SpindleDoubtsLaw, NothingFoldsWhereTheSpectrumHasFallen) {
  const SpindleBench bench = three_sensors(3, 128.0);
  const SpindleResult result = bench.separate();
  EXPECT_FALSE(noted(result, "fold"));
  EXPECT_LT(result.radial->sensitive.synchronous.u, 50e-6);
}

// The note states at 1° what the value is off by, to a factor of a few.
TEST(SpindleDoubtsLaw, UPerDegreeOfAnAngleIsStated) {
  SpindleOptions stated;
  stated.u_angle_rad = rad_per_deg;
  const SpindleBench bench = three_sensors(5, 128.0);
  const SpindleResult result = bench.separate();
  const double U_um = 2.0 * bench.separate(stated).radial->sensitive.synchronous.u / mm_per_um;
  char words[40];
  std::snprintf(words, sizeof words, "would be %.2g µm", U_um);
  EXPECT_TRUE(noted(result, words)) << words;
}

TEST(SpindleDoubtsLaw, ReIndexingOfTheOtherSignOrForgottenIsRefused) {
  SpindleBench bench(7, 30);
  bench.passes({1, 2, 3, 4, 5}, 12.0, 128.0);
  for (const int k : {1, 2, 3, 4, 5}) bench.setup(k, 72.0 * (k - 1));
  bench.scenario.noise.sigma_mm = 20e-6;
  const ProbeStream right = bench.stream();
  EXPECT_TRUE(separate_spindle({&right, 1}).radial);
  const auto why = [](const ProbeStream& stream) -> std::string {
    try {
      separate_spindle({&stream, 1});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  ProbeStream negated = right;
  for (auto& one : negated.setups) one.reindex_rad = -one.reindex_rad;
  EXPECT_NE(why(negated).find("every re-indexing angle has the other sign"), std::string::npos);
  ProbeStream forgotten = right;
  forgotten.setups[2].reindex_rad = 0.0;
  EXPECT_NE(why(forgotten).find("check the re-indexing angles"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis::laws
