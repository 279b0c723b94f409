// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>
#include <string>

namespace trueaxis::form {

/// A value on its way to its uncertainty: what a trial of a Monte Carlo gives.
struct NamedValue {
  std::string group, name, reference;
  double value;
  std::string unit = "mm";
};

/// √(Σ v² / n) of a column that is not empty.
inline double root_mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace trueaxis::form
