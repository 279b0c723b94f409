// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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

/// Heights over an element whose material is on the lower side, or on the upper as of a bore: a
/// peak is away from the material (ISO 12181-1, 12180-1).
struct PeakAndValley {
  PeakAndValley(double low, double high, bool material_outside)
      : peak(std::max(0.0, material_outside ? -low : high)),
        valley(std::max(0.0, material_outside ? high : -low)) {}
  double peak, valley;
};

}  // namespace trueaxis::form
