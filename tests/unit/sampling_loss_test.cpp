// SPDX-License-Identifier: Apache-2.0
// What a table of another maker's format, linear between its points, loses of an error.
#include <gtest/gtest.h>

#include <cmath>

#include "machine/sampled_errors.hpp"
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

}  // namespace
}  // namespace trueaxis
