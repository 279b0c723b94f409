// SPDX-License-Identifier: Apache-2.0
// A read-out beside balls, both made by the test's own matrices and formulas: one problem.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <functional>

#include "support/ball_bench.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::testing {
namespace {

constexpr double ball_sigma_mm = 1e-3, read_out_sigma_mm = 2e-3;
constexpr double low_mm = -250.0, high_mm = 250.0;

/// E_XX of the machine: (slope + bend (2 s − 1)) s over the range, s from 0 to 1.
ErrorTerm scale_of_x(double slope_mm, double bend_mm) {
  const double half = 0.5 * (high_mm - low_mm), middle = 0.5 * (low_mm + high_mm);
  return {{true, 0, 0}, PolynomialError{{0.0, slope_mm, bend_mm}, middle, half}, 0.0};
}

/// What a scale on X shows: actual less command is E_XX, as X carries the tool; there and back,
/// with noise. @param more of the instrument itself, of s from −1 to 1
MachineMeasurement read_x(const ErrorModel& errors, Draw& draw,
                          const std::function<double(double)>& more = {}) {
  MachineMeasurement data;
  data.source = "x.csv";
  data.kind = MeasurementKind::axis;
  data.axis = AxisName::X;
  std::normal_distribution<double> normal(0.0, read_out_sigma_mm);
  constexpr int positions = 41;
  for (int i = 0; i < 2 * positions; ++i) {
    const int k = i < positions ? i : 2 * positions - 1 - i;
    AxisPositions axes{};
    axes[0] = low_mm + k * (high_mm - low_mm) / (positions - 1);
    double error = 0.0;
    for (const ErrorTerm& one : errors.terms)
      if (one.name == ErrorName{true, 0, 0}) {
        const auto& p = std::get<PolynomialError>(one.function);
        const double s = (axes[0] - p.origin) / p.scale;
        for (std::size_t c = p.coefficients.size(); c-- > 0;) error = error * s + p.coefficients[c];
      }
    if (more) error += more(2.0 * k / (positions - 1) - 1.0);
    data.axes.push_back(axes);
    data.actual.push_back(axes[0] + error + 0.4 + normal(draw.engine));
  }
  return data;
}

MachineMeasurement balls(const Machine& machine, const ErrorModel& errors, Draw& draw) {
  BallPlan plan;
  plan.balls = {{220.0, 20.0, 40.0}, {-60.0, 190.0, 90.0}};
  plan.tool_lengths_mm = {120.0};
  return measure_balls({machine, errors}, plan, ball_sigma_mm, draw);
}

const CalibratedParameter* found_of(std::span<const CalibratedParameter> all, const char* name) {
  const auto at = std::ranges::find(all, name, &CalibratedParameter::name);
  return at == all.end() ? nullptr : &*at;
}

/// P₁ and P₂ of (slope, bend) over the range: s = P₁, s² = (2 P₂ + 1)/3.
struct Truth {
  double poly1, poly2;
};
Truth truth_of(double slope_mm, double bend_mm) { return {slope_mm, bend_mm / 1.5}; }

// What was given is subtracted from a read-out, as from balls: the truth given, nothing is left.
// Adding the whole read-out to it, the error would be there twice.
TEST(ReadOutBesideBalls, WhatIsGivenIsSubtracted) {
  const Machine machine = trunnion();
  for (const bool beside_balls : {false, true}) {
    Draw draw(1);
    ErrorModel errors;
    errors.terms = {scale_of_x(0.03, 0.01)};
    std::vector<MachineMeasurement> data{read_x(errors, draw)};
    if (beside_balls) data.push_back(balls(machine, errors, draw));
    CalibrationOptions options;
    options.errors = errors;
    const Calibration found = calibrate(machine, data, options);
    ASSERT_TRUE(found.converged);
    const AxisReadOut& own = found.read_outs.front();
    for (std::size_t degree = 1; degree < own.polynomial.size(); ++degree)
      EXPECT_NEAR(own.polynomial[degree].value, 0.0, 4.0 * own.polynomial[degree].u) << degree;
    double there = 0.0;
    for (const ErrorTerm& one : found.errors.terms)
      if (one.name == ErrorName{true, 0, 0})
        there += value_at(one.function, high_mm) - value_at(one.function, low_mm);
    // The odd coefficients, twice each; that of degree 3 is known no better.
    EXPECT_NEAR(there, 0.06, 4.0 * 2.0 * (own.polynomial[1].u + own.polynomial[3].u));
  }
}

// Parameters within 4 u of the truth, and U (k = 2) holds 95.4 %: within the binomial's 99.9 %. u
// is less than that of the read-out alone, as the balls are rows of the same problem.
TEST(ReadOutBesideBalls, CalibrationCoversTheTruth) {
  const Machine machine = trunnion();
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    ErrorModel errors = drawn_location_errors(machine, draw);
    const double slope = draw.between(-0.03, 0.03), bend = draw.between(-0.01, 0.01);
    errors.terms.push_back(scale_of_x(slope, bend));
    const std::vector<MachineMeasurement> data{balls(machine, errors, draw), read_x(errors, draw)};
    const Calibration found = calibrate(machine, data);
    ASSERT_TRUE(found.converged) << seed;
    const Truth truth = truth_of(slope, bend);
    const CalibratedParameter* const one = found_of(found.parameters, "EXX.poly1");
    const CalibratedParameter* const two = found_of(found.parameters, "EXX.poly2");
    ASSERT_NE(one, nullptr);
    ASSERT_NE(two, nullptr);
    EXPECT_NEAR(one->estimate.value, truth.poly1, 4.0 * one->estimate.u) << seed;
    EXPECT_NEAR(two->estimate.value, truth.poly2, 4.0 * two->estimate.u) << seed;
    for (const double off : {(one->estimate.value - truth.poly1) / one->estimate.u,
                             (two->estimate.value - truth.poly2) / two->estimate.u})
      inside += std::abs(off) <= 2.0 ? 1 : 0, ++all;
    EXPECT_LT(one->estimate.u, found.read_outs.front().polynomial[1].u) << seed;
  }
  using boost::math::binomial_distribution;
  EXPECT_LE(binomial_distribution<>::find_lower_bound_on_p(all, inside, 5e-4), 0.954) << inside;
  EXPECT_GE(binomial_distribution<>::find_upper_bound_on_p(all, inside, 5e-4), 0.954) << inside;
}

// A read-out whose own scale is wrong (a material temperature) is refuted by the balls: the effect
// is named with its size. One that is right is not: at 1 %, of 40 at most 3 (binomial, 99.9 %).
TEST(ReadOutBesideBalls, AWrongScaleIsRefuted) {
  const Machine machine = trunnion();
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    for (const double wrong_mm : {0.0, 0.06}) {
      if (wrong_mm > 0.0 && seed > 5) continue;
      Draw draw(seed);
      ErrorModel errors;
      errors.terms = {scale_of_x(0.02, 0.0)};
      const std::vector<MachineMeasurement> data{
          balls(machine, errors, draw),
          read_x(errors, draw, [&](double s) { return 0.5 * wrong_mm * s; })};
      const MachineDiagnosis found = diagnose_machine(machine, data);
      if (wrong_mm == 0.0) {
        alarms += found.verdict == DiagnosisVerdict::ideal ? 0 : 1;
        const CalibratedParameter* const one = found_of(found.extended, "EXX.poly1");
        ASSERT_NE(one, nullptr);
        EXPECT_NEAR(one->estimate.value, 0.02, 4.0 * one->estimate.u) << seed;
        continue;
      }
      ASSERT_EQ(found.findings.size(), 1U) << seed;
      EXPECT_EQ(found.findings.front().effect(), "read_out.X.scale") << seed;
      EXPECT_NEAR(found.findings.front().size, wrong_mm,
                  4.0 * found.findings.front().parameters.front().estimate.u)
          << seed;
    }
  EXPECT_LE(alarms, 3);
}

}  // namespace
}  // namespace trueaxis::testing
