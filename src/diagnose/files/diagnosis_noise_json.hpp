// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// σ of one reading, where it comes from, and what was left out. `autocorrelation` is that of
/// neighbouring readings, which follows from the autoregression.
Json noise_object(const NoiseReport& noise);

Json check_object(const QualityCheck& check);

/// Lag-1 autocorrelation of ε_i = Σ φ_j ε_{i−j} + e_i; 0 for white noise, NaN where it is not
/// stationary.
double neighbour_correlation(const std::vector<double>& autoregression);

}  // namespace trueaxis
