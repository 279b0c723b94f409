// SPDX-License-Identifier: Apache-2.0
// What an effect does to the axis: the virtual lathe against the projection of the effect's column,
// and against figures from plain geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "studies/axis_bias/axis_bias_cases.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

using namespace study;
using virtual_lathe::PartKind;
using virtual_lathe::Scenario;

Scenario reference(PartKind kind) {
  Scenario scenario = axis_bias_reference();
  scenario.part.kind = kind;
  if (kind == PartKind::cylinder) scenario.part.half_angle_rad = 0.0;
  if (kind == PartKind::face) {
    // Its axis is where the spindle's pierces it, as a diagnosis assumes.
    virtual_lathe::Part& part = scenario.part;
    const double n2 = 1.0 - part.l * part.l - part.m * part.m;
    part.d_mm = 12.0, part.half_angle_rad = 0.0;
    part.x0_mm = -part.l * part.d_mm / n2, part.y0_mm = -part.m * part.d_mm / n2;
    scenario.plan.passes[0].start_mm = 8.0, scenario.plan.passes[0].end_mm = 40.0;
    scenario.plan.passes[0].feed_mm_per_rev = 0.41;
  }
  return scenario;
}

class AxisBiasLaw : public ::testing::TestWithParam<PartKind> {};

// bias(a)/a = projection + O(a): half the size halves the error, and 2 × half − whole has none but
// what the third order leaves, which is less than the second where sizes are small. Rounding is
// that of contacts, and must itself be small compared with the bias.
TEST_P(AxisBiasLaw, LatheGoesToTheProjectionAsTheSizeGoesToZero) {
  const Scenario scenario = reference(GetParam());
  for (const AxisBiasCase& one : axis_bias_cases(scenario)) {
    SCOPED_TRACE(one.effect + " " + one.form);
    const AxisBiasRow row = axis_bias_of(scenario, one);
    EXPECT_LE(row.off, row.second_order + row.rounding);
    EXPECT_EQ(row.agrees, row.off <= row.second_order + row.rounding);
    EXPECT_LE(row.off_half, 0.55 * row.off_whole + row.rounding);
    EXPECT_LE(row.off_whole, 0.01 * std::max(row.predicted, 1e-3 / one.edge) + row.rounding);
    EXPECT_LE(row.rounding, 1e-3 * std::max(row.predicted, 1e-3 / one.edge));
  }
}

// With the effect's term in the fit the bias is of second order: per unit it halves with the size.
// What rounds grows as the uncertainty does.
TEST_P(AxisBiasLaw, TheExtendedModelHasNoFirstOrderLeft) {
  const Scenario scenario = reference(GetParam());
  int separable = 0;
  for (const AxisBiasCase& one : axis_bias_cases(scenario)) {
    SCOPED_TRACE(one.effect + " " + one.form);
    const AxisBiasRow row = axis_bias_of(scenario, one);
    if (!row.separable) {
      EXPECT_LT(row.left, 1e-4);  // absorbed: the surface can imitate it
      continue;
    }
    double contacts = 4e-11 / one.size / one.edge * std::max(1.0, row.u_ratio);
    if (GetParam() == PartKind::face) {  // its columns hold to the tilt's square
      const double tilt2 = scenario.part.l * scenario.part.l + scenario.part.m * scenario.part.m;
      contacts = std::max(contacts, 4.0 * tilt2 * row.predicted);
    }
    EXPECT_LE(row.extended_half, 0.55 * row.extended + contacts);
    EXPECT_LE(row.extended, 0.01 * std::max(row.predicted, 1e-3 / one.edge) + contacts);
    // A model with more to fit knows the axis less; 1 % for the axis' own place in the basis.
    EXPECT_GE(row.u_ratio, 0.99);
    ++separable;
  }
  // What goes around otherwise than once is not an axis: each part has many such effects.
  EXPECT_GE(separable, 10);
}

// A gauge whose nominal radius is off by 0.137 mm (a whole period of the cyclic case) misses the
// axis by some nm without any effect. This is not a bias. The rest is that the prediction is about
// a part of another radius: proportional to the radius' error, 10 times that is wide.
TEST_P(AxisBiasLaw, ARelativeGaugesOwnErrorIsNoHarm) {
  if (GetParam() == PartKind::face) GTEST_SKIP() << "a face has no nominal radius";
  Scenario scenario = reference(GetParam());
  const double radius_mm = GetParam() == PartKind::cone ? 43.0 : 40.0,
               off_mm = 0.137;  // in the middle
  scenario.probe.relative_zero_mm = radius_mm;
  scenario.probe.nominal_radius_mm = radius_mm + off_mm;
  for (const AxisBiasCase& one : axis_bias_cases(scenario)) {
    SCOPED_TRACE(one.effect + " " + one.form);
    const AxisBiasRow row = axis_bias_of(scenario, one);
    const double share = 10.0 * off_mm / radius_mm;
    const double least = 1e-3 / one.edge;
    EXPECT_LE(row.off, row.second_order + row.rounding + share * std::max(row.predicted, least));
    EXPECT_LE(row.off_half,
              0.55 * row.off_whole + row.rounding + share * std::max(row.predicted, least));
  }
}

// The sensor's working point is where the part is, whatever the gauge's zero: of a nonlinearity and
// of a scale the bias is that of an absolute probe. The columns of both fits differ in that of the
// constant alone, by (e/R)² of it at most; a part of another radius has the slopes of another.
TEST_P(AxisBiasLaw, AGaugesSensorWorksWhereThePartIs) {
  if (GetParam() == PartKind::face) GTEST_SKIP() << "a face has no nominal radius";
  Scenario absolute = reference(GetParam()), gauge = absolute;
  const double radius_mm = GetParam() == PartKind::cone ? 43.0 : 40.0, off_mm = 0.05;
  gauge.probe.relative_zero_mm = radius_mm;
  gauge.probe.nominal_radius_mm = radius_mm + off_mm;
  const auto plain = axis_bias_cases(absolute), relative = axis_bias_cases(gauge);
  ASSERT_EQ(plain.size(), relative.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const std::string& id = plain[i].effect;
    if (id != "probe.nonlinearity" && id != "probe.cyclic") continue;
    SCOPED_TRACE(id + " " + plain[i].form);
    const AxisBiasRow as_read = axis_bias_of(absolute, plain[i]),
                      by_gauge = axis_bias_of(gauge, relative[i]);
    const double close = 10.0 * off_mm / radius_mm * std::max(as_read.predicted, 1e-3);
    EXPECT_NEAR(by_gauge.limit, as_read.limit, close);
    EXPECT_NEAR(by_gauge.predicted, as_read.predicted, close);
    EXPECT_LE(by_gauge.off, by_gauge.second_order + by_gauge.rounding + close);
    EXPECT_EQ(by_gauge.separable, as_read.separable);
  }
}

TEST_P(AxisBiasLaw, EveryEffectOfTheCatalogueHasACase) {
  std::set<std::string_view> covered;
  const std::vector<AxisBiasCase> cases = axis_bias_cases(reference(GetParam()));
  for (const AxisBiasCase& one : cases) covered.insert(one.effect);
  for (const Effect& effect : effect_catalogue()) {
    // Of a cone a taper is the angle itself. A play has no limit (PlayTurnsTheAxis).
    const StreamKind kind = GetParam() == PartKind::face ? StreamKind::face : StreamKind::lateral;
    const bool asked = !effect.check && effect.needs.stream.value_or(kind) == kind &&
                       !(effect.id == "part.taper" && GetParam() == PartKind::cone) &&
                       effect.id != "probe.hysteresis";
    EXPECT_EQ(covered.contains(effect.id), asked) << effect.id;
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, AxisBiasLaw,
                         ::testing::Values(PartKind::cone, PartKind::cylinder, PartKind::face),
                         [](const auto& part) {
                           return part.param == PartKind::cone       ? "Cone"
                                  : part.param == PartKind::cylinder ? "Cylinder"
                                                                     : "Face";
                         });

const AxisBiasCase& case_of(const std::vector<AxisBiasCase>& cases, const std::string& effect) {
  return *std::ranges::find(cases, effect, &AxisBiasCase::effect);
}

// On a cylinder some biases are plain geometry. The axis is |a| off the spindle's at the far end:
// another zero of C turns it (|a| per rad), a delay turns it by ω τ, a gain scales it, a height h
// turns the contact by asin(h/R). Corrections are of the order of tilt × feed and (e/R)²: 1e-3.
TEST(AxisBiasGeometry, FiguresOfACylinder) {
  const Scenario scenario = reference(PartKind::cylinder);
  const std::vector<AxisBiasCase> cases = axis_bias_cases(scenario);
  const auto& part = scenario.part;
  const double end = scenario.plan.passes[0].end_mm;
  const double away = std::hypot(part.x0_mm + part.l * end, part.y0_mm + part.m * end);
  const auto expect = [&](const char* effect, double value) {
    EXPECT_NEAR(axis_bias_of(scenario, case_of(cases, effect)).limit, value, 2e-3 * value)
        << effect;
  };
  expect("encoder.offset", away * rad_per_deg);
  expect("probe.latency", away * two_pi);  // 60 rpm
  expect("probe.gain", away);
  expect("probe.height", away / part.radius_mm);
}

// What a play leaves of a harmonic of amplitude A is its describing function: with k = b/2A
// ((π/2 + asin(1 − 2k) + 2(1 − 2k)√(k(1 − k))) − j 4k(1 − k))/π. Towards b = 0 the axis is off by
// 2/π of it. The orders 3, 5, … that come with it leave the axis alone over whole revolutions.
TEST(AxisBiasGeometry, PlayTurnsTheAxis) {
  Scenario scenario = reference(PartKind::cylinder);
  virtual_lathe::Part& part = scenario.part;
  part.l = part.m = 0.0;
  const double away = std::hypot(part.x0_mm, part.y0_mm);
  for (const double play_mm : {1e-4, 0.01, 0.1}) {
    SCOPED_TRACE(play_mm);
    scenario.effects = {{"probe.hysteresis", {{"play_mm", play_mm}}}};
    FitOptions options;
    options.surface = SurfaceKind::cylinder;
    const FitResult fit = trueaxis::fit(virtual_lathe::simulate(scenario), options);
    const double k = play_mm / (2.0 * away), pi = 0.5 * two_pi;
    const double in_phase =
        (0.5 * pi + std::asin(1.0 - 2.0 * k) + 2.0 * (1.0 - 2.0 * k) * std::sqrt(k * (1.0 - k))) /
        pi;
    const double across = 4.0 * k * (1.0 - k) / pi;
    const double off_mm = away * std::hypot(1.0 - in_phase, across);
    const auto at = fit.shape.axis.at(0.5 * (fit.position_min_mm + fit.position_max_mm));
    const double found_mm = std::hypot(at[0] - part.x0_mm, at[1] - part.y0_mm);
    // Turns that end in the middle leak the odd orders: 1 % where there are thirty.
    EXPECT_NEAR(found_mm, off_mm, 0.02 * off_mm);
    if (play_mm < 1e-3) {
      EXPECT_NEAR(found_mm / play_mm, find_effect("probe.hysteresis")->axis_bias->value, 0.01);
    }
  }
}

// The catalogue's figures that do not depend on how the turns end, to the digits that it gives.
TEST(AxisBiasGeometry, FiguresOfTheCatalogue) {
  const Scenario scenario = axis_bias_reference();
  const struct {
    const char *effect, *form;
    double half_a_digit;
  } figures[] = {{"encoder.offset", "", 5e-5},
                 {"probe.latency", "", 5e-3},
                 {"probe.gain", "", 5e-3},
                 {"probe.height", "", 5e-4},
                 {"probe.ball_radius", "", 1e-7},
                 {"part.bow", "from the lower end", 5e-3},
                 {"part.slip", "radial, at two thirds", 5e-3}};
  std::size_t compared = 0;
  for (const AxisBiasCase& one : axis_bias_cases(scenario)) {
    for (const auto& figure : figures) {
      if (one.effect != figure.effect || one.form != figure.form) continue;
      ASSERT_TRUE(one.stated.has_value()) << one.effect;
      EXPECT_NEAR(axis_bias_of(scenario, one).limit, *one.stated, figure.half_a_digit)
          << one.effect;
      ++compared;
    }
  }
  EXPECT_EQ(compared, std::size(figures));
}

}  // namespace
}  // namespace trueaxis::testing
