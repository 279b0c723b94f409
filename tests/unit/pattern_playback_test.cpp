// SPDX-License-Identifier: Apache-2.0
// Patterns that no cause explains, from the diagnosis' file through the virtual lathe: on a centred
// cylinder a reading is the radius plus the pattern, whose formula stands here.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "diagnose/files/diagnosis_json.hpp"
#include "resimulate/diagnosis_scenario.hpp"
#include "simulate/resimulate.hpp"
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
  d.extended = fit;
  d.noise.sigma_mm = 0.001;
  d.z_mid_mm = d.z_half_mm = 0.5 * length_mm;
  d.unexplained = {pattern};
  return d;
}

void expect_played(const Unexplained& pattern, const std::function<double(const At&)>& formula,
                   double tolerance_mm = 1e-12) {
  const ProbeStream stream = measured();
  DiagnosedScenarios scenarios =
      diagnosed_scenarios(diagnosis_json(diagnosed(pattern)), "diagnosis.json", stream);
  const auto before = virtual_lathe::resimulate(scenarios.before, stream, scenarios.masked);
  const auto after = virtual_lathe::resimulate(scenarios.after, stream, scenarios.masked);
  ASSERT_GT(stream.size(), 500u);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const At at{stream.c_rad[i], stream.position_mm[i], stream.time_s[i]};
    ASSERT_NEAR(before[i], radius_mm, 1e-12);
    ASSERT_NEAR(after[i] - radius_mm, formula(at), tolerance_mm)
        << "C " << at.c << ", Z " << at.z << ", t " << at.t;
  }
}

Unexplained pattern(double order, int degree) {
  Unexplained out;
  out.harmonic = "a pattern";
  out.order = order;
  out.degree = degree;
  out.linear = {a, b};
  return out;
}

double wave(double angle) { return a * std::cos(angle) + b * std::sin(angle); }
double p2(double u) { return 0.5 * (3.0 * u * u - 1.0); }

TEST(PatternPlayback, CellAlongZ) {
  for (const bool of_part : {false, true}) {
    Unexplained cell = pattern(5.0, 2);
    cell.part_frame = of_part;
    expect_played(cell, [](const At& at) { return p2(at.u()) * wave(5.0 * at.c); });
  }
}

TEST(PatternPlayback, CellWithoutAnOrderHasOneFactor) {
  Unexplained cell = pattern(0.0, 2);
  cell.linear = {a};
  cell.part_frame = true;
  expect_played(cell, [](const At& at) { return a * p2(at.u()); });
}

TEST(PatternPlayback, CellAlongTime) {
  Unexplained cell = pattern(2.0, 1);
  cell.in_time = true;
  const double lasted = measured().time_s.back();
  expect_played(cell, [=](const At& at) { return (2.0 * at.t / lasted - 1.0) * wave(2.0 * at.c); });
}

TEST(PatternPlayback, LineAlongZ) {
  for (const double per_mm : {0.14, -0.09, 0.0}) {
    Unexplained line = pattern(7.41, -1);
    line.z_frequency = per_mm;
    line.part_frame = true;
    // The angle of a part that turned n times is that of its last turn: an order that is no whole
    // number starts anew at ±180°.
    expect_played(line, [=](const At& at) {
      return wave(7.41 * std::remainder(at.c, two_pi) - two_pi * per_mm * at.z);
    });
  }
}

TEST(PatternPlayback, LineInTime) {
  Unexplained line = pattern(1.0, -1);
  line.in_time = true;
  line.dependence = "turning with 3.25 Hz";
  expect_played(line, [](const At& at) { return wave(at.c - two_pi * 3.25 * at.t); });
}

TEST(PatternPlayback, LocalForm) {
  Unexplained bump;
  bump.harmonic = "local form";
  bump.dependence = "at 70.0° (± 12.5°), Z 18.00 mm (± 3.50 mm)";
  bump.part_frame = true;
  bump.linear = {a};
  const auto over_angle = [](double c) {
    return std::remainder(c - 70.0 * rad_per_deg, two_pi) / (12.5 * rad_per_deg);
  };
  expect_played(bump, [&](const At& at) {
    return a * std::exp(-0.5 * (std::pow(over_angle(at.c), 2) + std::pow((at.z - 18) / 3.5, 2)));
  });
  bump.dependence = "at 70.0° (± 12.5°)";
  expect_played(bump,
                [&](const At& at) { return a * std::exp(-0.5 * std::pow(over_angle(at.c), 2)); });
}

TEST(PatternPlayback, WhatHasNoPlaceIsRefused) {
  const ProbeStream stream = measured();
  Unexplained changing = pattern(3.0, 1);
  changing.in_time = changing.part_frame = true;
  Unexplained placeless;
  placeless.harmonic = "local form";
  placeless.linear = {a};
  Unexplained empty = pattern(3.0, 0);
  empty.linear = {};
  for (const Unexplained& bad : {changing, placeless, empty}) {
    EXPECT_THROW(diagnosed_scenarios(diagnosis_json(diagnosed(bad)), "d.json", stream), InputError);
  }
}

}  // namespace
}  // namespace trueaxis
