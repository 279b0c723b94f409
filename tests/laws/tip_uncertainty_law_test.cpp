// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <iostream>

#include "machine/uncertainty.hpp"
#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"

namespace trueaxis::testing {
namespace {

/// Amounts of every kind and body, and a covariance of 8 directions only among them, of about 10 µm
/// and 20 µrad: most of them are correlated, and none has its own direction.
ErrorCovariance drawn_covariance(const Machine& machine, Draw& draw,
                                 std::vector<std::vector<double>>& root) {
  using Shape = UncertainAmount::Shape;
  std::vector<UncertainAmount> amounts;
  for (const MachineAxis& axis : machine.axes) {
    const std::size_t body = index_of(axis.name);
    const bool rotary = is_rotary(axis.name);
    for (std::size_t d = 0; d < 6; ++d) {
      if (!without_effect({false, d, body})) amounts.push_back({.name = {false, d, body}});
      const ErrorName component{true, d, body};
      if (draw.whole(0, 1) == 0)
        amounts.push_back({component, Shape::legendre, draw.whole(1, 3), rotary ? -3.0 : -500.0,
                           rotary ? 3.0 : 500.0});
      else
        amounts.push_back({component, draw.whole(0, 1) == 0 ? Shape::cosine : Shape::sine,
                           draw.whole(1, 4), 0.0, rotary ? two_pi : 700.0});
    }
  }
  for (std::size_t d = 0; d < 6; ++d) {
    amounts.push_back({.name = {false, d, spindle_body}});
    amounts.push_back({.name = {false, d, workpiece_body}});
  }
  const std::size_t n = amounts.size(), directions = 8;
  root.assign(n, std::vector<double>(directions));
  for (std::size_t i = 0; i < n; ++i)
    for (double& one : root[i])
      one = draw.between(-1.0, 1.0) * (amounts[i].name.angular() ? 20e-6 : 10e-3) /
            std::sqrt(static_cast<double>(n));
  ErrorCovariance out(std::move(amounts));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < directions; ++k) out(i, j) += root[i][k] * root[j][k];
  return out;
}

// Amounts are drawn by the root of their covariance and put through the exact chain, multiplied out
// as 4×4 matrices. A variance of n draws has a standard deviation of √(2/n) of itself, a covariance
// of √((vᵢvⱼ + cᵢⱼ²)/n): five of them are exceeded once in 1.7 million numbers.
TEST(TipUncertaintyLaw, IsThatOfDrawsThroughTheExactChain) {
  constexpr int draws = 3000;
  double worst = 0.0;
  std::uint64_t seed = 0;
  for (const Layout& layout : layouts()) {
    Draw draw(++seed);
    const Machine machine = draw.machine(layout);
    ErrorModel errors = draw.errors(machine, 0.03, 100e-6);
    std::vector<std::vector<double>> root;
    errors.covariance = drawn_covariance(machine, draw, root);
    // In addition to the covariance an error that is uncertain for itself.
    errors.terms.push_back({{false, 3, index_of(machine.axes[0].name)}, ConstantError{}, 0.0});
    if (without_effect(errors.terms.back().name)) errors.terms.pop_back();
    const Setting setting = first_setting(machine);
    const AxisPositions at = draw.positions(machine);
    const Matrix3 said = TipUncertainty(MachineModel(machine, errors)).covariance_mm2(at, setting);
    const Vector3 centre = tip_of(ChainMatrices{machine, errors}.tool_in_part(at, setting));
    double sum[3][3] = {};
    std::normal_distribution<double> normal;
    ErrorModel drawn = errors;
    const std::size_t first = drawn.terms.size();
    for (const UncertainAmount& amount : errors.covariance.names())
      drawn.terms.push_back({amount.name, amount.unit(), 0.0});
    for (int i = 0; i < draws; ++i) {
      std::vector<double> z(root.front().size());
      for (double& one : z) one = normal(draw.engine);
      for (std::size_t a = 0; a < root.size(); ++a) {
        double value = 0.0;
        for (std::size_t k = 0; k < z.size(); ++k) value += root[a][k] * z[k];
        ErrorFunction function = errors.covariance.names()[a].unit();
        if (auto* constant = std::get_if<ConstantError>(&function)) constant->value *= value;
        if (auto* polynomial = std::get_if<PolynomialError>(&function))
          for (double& c : polynomial->coefficients) c *= value;
        if (auto* fourier = std::get_if<FourierError>(&function))
          for (auto& term : fourier->terms) term.cos *= value, term.sin *= value;
        drawn.terms[first + a].function = function;
      }
      const Vector3 tip = tip_of(ChainMatrices{machine, drawn}.tool_in_part(at, setting));
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          sum[r][c] += (tip[r] - centre[r]) * (tip[c] - centre[c]);
    }
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        const double sigma = std::sqrt((said[r][r] * said[c][c] + said[r][c] * said[r][c]) / draws);
        const double off = std::abs(sum[r][c] / draws - said[r][c]) / sigma;
        worst = std::fmax(worst, off);
        EXPECT_LT(off, 5.0) << layout.name << ' ' << r << c << ": " << sum[r][c] / draws << " for "
                            << said[r][c];
      }
  }
  std::cout << "worst of " << 9 * seed << " numbers: " << worst << " standard deviations\n";
}

// What is not in the covariance counts for itself: squares add, to what single precision keeps of
// the covariance's root, 2⁻²⁴ a product, 70 of them in a sum.
TEST(TipUncertaintyLaw, AddsWhatIsUncertainAlone) {
  Draw draw(3);
  const Machine machine = draw.machine(layouts().front());
  std::vector<std::vector<double>> root;
  ErrorModel together, alone, both;
  both.covariance = together.covariance = drawn_covariance(machine, draw, root);
  alone.terms = {{{false, 1, spindle_body}, ConstantError{0.0}, 0.02}};
  both.terms = alone.terms;
  gather_uncertainty(both);
  EXPECT_EQ(both.terms.front().u, 0.0);
  const Setting setting = first_setting(machine);
  const AxisPositions at = draw.positions(machine);
  const auto square = [&](const ErrorModel& errors) {
    return std::pow(TipUncertainty(MachineModel(machine, errors)).u_mm(at, setting), 2);
  };
  EXPECT_NEAR(square(both), square(together) + square(alone), 70.0 * 6e-8 * square(both));
}

}  // namespace
}  // namespace trueaxis::testing
