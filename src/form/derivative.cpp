// SPDX-License-Identifier: Apache-2.0
#include "form/derivative.hpp"

#include <cmath>
#include <limits>

#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

/// d/dx of the Lagrange polynomials through `at` at its entry `here`.
std::array<double, 5> lagrange_slopes(const std::array<double, 5>& at, std::size_t here) {
  std::array<double, 5> weight{};
  for (std::size_t j = 0; j < 5; ++j) {
    if (j == here) {
      for (std::size_t m = 0; m < 5; ++m)
        if (m != here) weight[j] += 1.0 / (at[here] - at[m]);
      continue;
    }
    double product = 1.0 / (at[j] - at[here]);
    for (std::size_t m = 0; m < 5; ++m)
      if (m != j && m != here) product *= (at[here] - at[m]) / (at[j] - at[m]);
    weight[j] = product;
  }
  return weight;
}

}  // namespace

Derivative::Derivative(const Trace& trace, double longest_step)
    : stencils_(trace.size()), known_(trace.size(), false) {
  const auto n = static_cast<std::ptrdiff_t>(trace.size());
  const auto wrapped = [&](std::ptrdiff_t i) {
    return static_cast<std::size_t>(((i % n) + n) % n);
  };
  const auto joined = [&](std::ptrdiff_t i) {  // reading i with the next one
    if (!trace.closed() && (i < 0 || i + 1 >= n)) return false;
    return trace.step(wrapped(i)) <= longest_step;
  };
  if (n < 5) return;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    for (const std::ptrdiff_t left : {2, 1, 3, 0, 4}) {  // as much to the left; the middle first
      bool whole = true;
      for (std::ptrdiff_t j = i - left; j < i - left + 4; ++j) whole = whole && joined(j);
      if (!whole) continue;
      std::array<double, 5> at{};
      Stencil& stencil = stencils_[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < 5; ++k) {
        const std::ptrdiff_t j = i - left + static_cast<std::ptrdiff_t>(k);
        stencil.reading[k] = wrapped(j);
        at[k] = trace.at[wrapped(j)] + (j < 0 ? -trace.period : j >= n ? trace.period : 0.0);
      }
      stencil.weight = lagrange_slopes(at, static_cast<std::size_t>(left));
      known_[static_cast<std::size_t>(i)] = true;
      break;
    }
  }
}

std::vector<double> Derivative::operator()(std::span<const double> value) const {
  expects(value.size() == stencils_.size(), "a value for every place");
  std::vector<double> out(value.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!known_[i]) continue;
    double sum = 0.0;
    for (std::size_t k = 0; k < 5; ++k)
      sum += stencils_[i].weight[k] * value[stencils_[i].reading[k]];
    out[i] = sum;
  }
  return out;
}

}  // namespace trueaxis::form
