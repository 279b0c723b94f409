// SPDX-License-Identifier: Apache-2.0
// A shaft with a bell mouth or a chamfer at an end, written here: it is no slip, and moves no axis.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {
namespace {

constexpr double length_mm = 40.0, radius_mm = 25.0, turns = 30.0, sigma_mm = 1e-3;
constexpr double x_mm = 0.04, y_mm = -0.03, slope_x = 2e-4, slope_y = -1e-4;

/// Every section is a circle about a point that moves along Z; `end` is added to its radius.
ProbeStream shaft(const std::function<double(double z_mm)>& end_mm, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  ProbeStream out;
  constexpr int per_turn = 72;
  for (int i = 0; i <= static_cast<int>(turns) * per_turn; ++i) {
    const double turned = static_cast<double>(i) / per_turn, z = length_mm * turned / turns;
    const double c = 2.0 * std::numbers::pi * turned, r = radius_mm + end_mm(z);
    const double x = x_mm + slope_x * z, y = y_mm + slope_y * z;
    const double across = y * std::cos(c) - x * std::sin(c);
    out.reading_mm.push_back(x * std::cos(c) + y * std::sin(c) +
                             std::sqrt(r * r - across * across) + noise(random));
    out.c_rad.push_back(c), out.position_mm.push_back(z), out.time_s.push_back(0.5 * turned);
  }
  return out;
}

/// That the end is named and the axis is where it is. @returns whether a slip is named, too
bool slips(const ProbeStream& stream, const std::string& what) {
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cylinder;
  const Diagnosis found = diagnose(stream, options);
  EXPECT_TRUE(std::ranges::any_of(found.findings, [](const Finding& f) {
    return f.may_be("part.end_form");
  })) << what;
  if (!found.extended.axis_known()) return true;
  for (const double z : {0.0, length_mm}) {
    const auto [x, y] = found.extended.axis.axis.at(z);
    const double off = std::hypot(x - x_mm - slope_x * z, y - y_mm - slope_y * z);
    // Beyond 3.5 u in one of 457 (Rayleigh); none of 24 ends is, with 95 % confidence.
    EXPECT_LT(off, 3.5 * found.extended.axis.u_at(z)) << what;
  }
  return found.slip() != nullptr;
}

// Up to ten times the noise: what a curve of one length leaves of a straight chamfer is below it.
// Without the form, 2 of 24 such streams slipped and 3 had feed marks of the probe's lead; with it,
// one slipped. Three of twelve would, at that rate, once in 100 times.
TEST(EndForm, ABellMouthOrAChamferIsNoSlip) {
  const double reach = 3.3 * length_mm / turns;
  const auto share = [&](double from_end) { return std::max(0.0, 1.0 - from_end / reach); };
  int slipped = 0;
  for (const std::uint64_t seed : {1u, 2u}) {
    for (const double depth_mm : {-0.005, -0.01, 0.01}) {
      slipped += slips(shaft([&](double z) { return depth_mm * share(z); }, seed), "chamfer");
      slipped +=
          slips(shaft([&](double z) { return depth_mm * std::pow(share(length_mm - z), 2); }, seed),
                "bell mouth");
    }
  }
  EXPECT_LT(slipped, 3);
}

}  // namespace
}  // namespace trueaxis
