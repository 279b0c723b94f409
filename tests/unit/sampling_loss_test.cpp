// SPDX-License-Identifier: Apache-2.0
// What a table of another maker's format, linear between its points, loses of an error.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "machine/sampled_errors.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// A chord of cos over the step h lies off it by 1 − cos(h/2) if h is centred on a crest. If a crest
// is a point of the table, it is cos(h/2) of that.
TEST(SamplingLoss, IsTheSagOfTheChord) {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.chain = "w C' b X Y Z t";
  machine.axes = parse_chain(machine.chain, none);
  ErrorModel errors;
  const ErrorName name{true, 1, index_of(AxisName::C)};
  errors.terms = {{name, FourierError{{{12.0, 5e-3, 0.0}}, two_pi}, 0.0}};
  for (const int points : {101, 301}) {
    const double half = 12.0 * 3.14159265358979 / (points - 1), sag = 5e-3 * (1.0 - std::cos(half));
    const SamplingLoss loss = sampling_loss(machine, errors, errors.sign, points);
    EXPECT_LE(loss.length_mm, sag * (1.0 + 1e-9)) << points;
    EXPECT_GE(loss.length_mm, 0.98 * std::cos(half) * sag) << points;
    EXPECT_EQ(loss.angle_rad, 0.0);
  }
}

TEST(SamplingLoss, OfAStraightLineIsNothing) {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.chain = "w C' b X Y Z t";
  machine.axes = parse_chain(machine.chain, none);
  for (MachineAxis& axis : machine.axes) axis.low = -200.0, axis.high = 300.0;
  ErrorModel errors;
  errors.terms = {{{true, 0, 0}, PolynomialError{{0.0, 1e-4}, 0.0, 1.0}, 0.0}};
  EXPECT_LT(sampling_loss(machine, errors, errors.sign, 11).length_mm, 1e-15);
}

/// Table positions of one axis, in its unit.
std::vector<double> table_of(const std::vector<ErrorTerm>& terms, double low, double high) {
  Machine machine;
  std::vector<ChainTrouble> none;
  machine.chain = "w A' b X Y Z t";
  machine.axes = parse_chain(machine.chain, none);
  for (MachineAxis& axis : machine.axes)
    if (index_of(axis.name) == terms.front().name.body) axis.low = low, axis.high = high;
  ErrorModel errors;
  errors.terms = terms;
  return sample_components(machine, errors, errors.sign, 11).front().positions;
}

// As far as `outside_known` lets a program go: a tenth of the range beyond its ends.
TEST(SampledErrors, GoAsFarAsTheyAreKnown) {
  const ErrorTerm known{{true, 0, 0}, PolynomialError{{0.0, 1e-2}, 0.0, 100.0}, 0.0, {{-100, 100}}};
  const ErrorTerm table{{true, 1, 0}, TableError{{-300.0, 0.0, 90.0}, {0.0, 0.0, 0.0}}, 0.0};
  const std::vector<double> at = table_of({known, table}, -400.0, 110.0);
  EXPECT_NEAR(at.front(), -120.0, 1e-12);
  EXPECT_NEAR(at.back(), 110.0, 1e-12);
}

// Over 0 … 360° alone A-80 would be 280, where a polynomial is another number.
TEST(SampledErrors, OfATurnOnlyWhatRepeatsEveryTurn) {
  const double none = std::numeric_limits<double>::infinity(), deg = rad_per_deg;
  const ErrorName a{true, 0, index_of(AxisName::A)};
  const ErrorTerm square{a, PolynomialError{{0.0, 0.0, 2e-2}, 0.0, 0.5 * two_pi}, 0.0};
  const ErrorTerm wave{a, FourierError{{{2.0, 1e-3, 0.0}}, two_pi}, 0.0};
  const ErrorTerm round{a, TableError{{0.0, 0.5 * two_pi, two_pi}, {0.0, 1e-3, 0.0}, true}, 0.0};
  const ErrorTerm ends{a, TableError{{-80 * deg, 20 * deg}, {0.0, 1e-3}}, 0.0};
  ErrorTerm known = square;
  known.known_over = {-80.0 * deg, 20.0 * deg};
  EXPECT_EQ(table_of({wave}, -none, none).back(), two_pi);
  EXPECT_EQ(table_of({round}, -none, none).size(), 3U);
  EXPECT_EQ(table_of({ends}, -none, none).size(), 2U);
  for (const auto& wrong :
       {std::vector{square}, std::vector{round, square}, std::vector{round, ends}})
    EXPECT_THROW(table_of(wrong, -none, none), InputError);
  for (const auto& terms : {std::vector{known}, std::vector{round, known}}) {
    const std::vector<double> at = table_of(terms, -none, none);
    EXPECT_NEAR(at.front(), -90.0 * deg, 1e-12);
    EXPECT_NEAR(at.back(), 30.0 * deg, 1e-12);
  }
}

}  // namespace
}  // namespace trueaxis
