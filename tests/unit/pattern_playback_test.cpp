// SPDX-License-Identifier: Apache-2.0
// Patterns that no cause explains, from the diagnosis' file through the virtual lathe: on a centred
// cylinder a reading is the radius plus the pattern, whose formula stands here.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "diagnose/files/diagnosis_json.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

constexpr double radius_mm = 40.0, length_mm = 30.0, a = 0.003, b = -0.002;

/// What a pattern is a function of.
struct At {
  double c, z, t;
  double u() const { return 2.0 * z / length_mm - 1.0; }
};

ProbeStream measured() {
  virtual_lathe::Scenario scenario;
  scenario.part.radius_mm = radius_mm;
  virtual_lathe::PlannedPass pass;
  pass.end_mm = length_mm;
  pass.feed_mm_per_rev = 1.3;
  pass.readings_per_revolution = 23.7;
  scenario.plan.passes = {pass};
  return virtual_lathe::simulate(scenario);
}

Diagnosis diagnosed(const Unexplained& pattern) {
  Diagnosis d;
  FitResult& fit = d.baseline;
  fit.surface = SurfaceKind::cylinder;
  fit.status = FitStatus::converged;
  fit.shape.radius_mm = radius_mm;
  d.named = d.extended = fit;
  d.noise.sigma_mm = 0.001;
  d.z_mid_mm = d.z_half_mm = 0.5 * length_mm;
  d.unexplained = {pattern};
  return d;
}

void expect_played(const Unexplained& pattern, const std::function<double(const At&)>& formula,
                   double tolerance_mm = 1e-12) {
  const ProbeStream stream = measured();
  const Diagnosis diagnosis =
      diagnosis_from_json(diagnosis_json(diagnosed(pattern)), "diagnosis.json");
  const auto [before, after] = resimulate(diagnosis, stream).readings;
  ASSERT_EQ(after.size(), stream.size());
  ASSERT_GT(stream.size(), 500u);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const At at{stream.c_rad[i], stream.position_mm[i], stream.time_s[i]};
    ASSERT_NEAR(before[i], radius_mm, 1e-12);
    ASSERT_NEAR(after[i] - radius_mm, formula(at), tolerance_mm)
        << "C " << at.c << ", Z " << at.z << ", t " << at.t;
  }
}

Unexplained pattern(const Pattern& of) {
  Unexplained out;
  out.term.pattern = of;
  out.term.linear = {a, b};
  return out;
}

double wave(double angle) { return a * std::cos(angle) + b * std::sin(angle); }
double p2(double u) { return 0.5 * (3.0 * u * u - 1.0); }

TEST(PatternPlayback, CellAlongZ) {
  for (const bool of_part : {false, true}) {
    const Pattern cell{.order = 5.0, .spindle = !of_part, .degree = 2};
    expect_played(pattern(cell), [](const At& at) { return p2(at.u()) * wave(5.0 * at.c); });
  }
}

TEST(PatternPlayback, CellWithoutAnOrderHasOneFactor) {
  Unexplained cell = pattern({.degree = 2});
  cell.term.linear = {a};
  expect_played(cell, [](const At& at) { return a * p2(at.u()); });
}

TEST(PatternPlayback, CellAlongTime) {
  const Unexplained cell = pattern({.order = 2.0, .spindle = true, .degree = 1, .in_time = true});
  const double lasted = measured().time_s.back();
  expect_played(cell, [=](const At& at) { return (2.0 * at.t / lasted - 1.0) * wave(2.0 * at.c); });
}

TEST(PatternPlayback, LineAlongZ) {
  for (const double per_mm : {0.14, -0.09, 0.0}) {
    const Unexplained line =
        pattern({.kind = Pattern::Kind::line, .order = 7.41, .frequency = per_mm});
    // The angle of a part that turned n times is that of its last turn: an order that is not a
    // whole number starts anew at ±180°.
    expect_played(line, [=](const At& at) {
      return wave(7.41 * std::remainder(at.c, two_pi) - two_pi * per_mm * at.z);
    });
  }
}

TEST(PatternPlayback, LineInTime) {
  const Unexplained line = pattern({.kind = Pattern::Kind::line,
                                    .order = 1.0,
                                    .spindle = true,
                                    .in_time = true,
                                    .frequency = 3.25});
  expect_played(line, [](const At& at) { return wave(at.c - two_pi * 3.25 * at.t); });
}

TEST(PatternPlayback, LocalForm) {
  Unexplained bump = pattern({.kind = Pattern::Kind::bump,
                              .angle_rad = 70.0 * rad_per_deg,
                              .position_mm = 18.0,
                              .width_rad = 12.5 * rad_per_deg,
                              .length_mm = 3.5});
  bump.term.linear = {a};
  const auto over_angle = [](double c) {
    return std::remainder(c - 70.0 * rad_per_deg, two_pi) / (12.5 * rad_per_deg);
  };
  expect_played(bump, [&](const At& at) {
    return a * std::exp(-0.5 * (std::pow(over_angle(at.c), 2) + std::pow((at.z - 18) / 3.5, 2)));
  });
  bump.term.pattern.length_mm = 0.0;
  expect_played(bump,
                [&](const At& at) { return a * std::exp(-0.5 * std::pow(over_angle(at.c), 2)); });
}

TEST(PatternPlayback, WhatHasNoPlaceIsRefused) {
  const ProbeStream stream = measured();
  const Unexplained changing = pattern({.order = 3.0, .degree = 1, .in_time = true});
  Unexplained placeless = pattern({.kind = Pattern::Kind::bump});
  placeless.term.linear = {a};
  Unexplained empty = pattern({.order = 3.0});
  empty.term.linear = {};
  for (const Unexplained& bad : {changing, placeless, empty}) {
    EXPECT_THROW(diagnosed_scenarios(diagnosed(bad), stream), InputError);
    EXPECT_NE(resimulate(diagnosed(bad), stream).why_not, "");
  }
}

}  // namespace
}  // namespace trueaxis
