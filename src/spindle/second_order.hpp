// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "spindle/recording.hpp"

namespace trueaxis {

/// Re Σ z_n exp(in α), n = 0 … : a form or a motion.
using Series = std::vector<std::complex<double>>;
double value_at(const Series& series, double angle_rad);

/// What the linear equation leaves out of a sensor's readings (Eq. 148): the exact reading of a
/// part that is off-centre, moves and has a form, less the sum of the three. In mm, one a reading.
/// @param eccentricity of the part in this set-up: it is off by Re(e exp(iψ)) towards ψ = C + θ.
std::vector<double> second_order(const RunReadings& run, std::size_t sensor, double sensitive_rad,
                                 std::complex<double> eccentricity, const Series& form,
                                 const Series& along, const Series& across);

}  // namespace trueaxis
