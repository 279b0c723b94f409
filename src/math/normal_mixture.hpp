// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace trueaxis {

/// A normal that is there with a probability.
struct NormalPart {
  double probability = 0.0, mean = 0.0, sd = 0.0;
};

/// A quantity that is one of several normals, or 0 with what their probabilities lack of 1.
using NormalMixture = std::vector<NormalPart>;

/// q with P(|e − E e| ≤ q) = level for the sum e of a normal and independent mixtures, to 0.1 %, by
/// inversion of its characteristic function (Gil-Pelaez 1951).
/// @param sd of the normal, above 0
double central_quantile(double sd, std::span<const NormalMixture> summands, double level);

}  // namespace trueaxis
