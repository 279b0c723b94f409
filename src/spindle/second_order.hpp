// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "spindle/recording.hpp"

namespace trueaxis {

/// Re Σ z_n exp(in α), n = 0 … : a form or a motion.
using Series = std::vector<std::complex<double>>;
double value_at(const Series& series, double angle_rad);

/// What is known of the part in a run.
struct PartInRun {
  std::complex<double> eccentricity;  ///< it is off by Re(e exp(iψ)) towards ψ = C + θ
  const Series &form, &along, &across;
};

/// What the linear equation leaves out of a sensor's reading (Eq. 148): the exact reading of a part
/// that is off-centre, moves and has a form, less the sum of the three, as harmonics of C of order
/// 0 … `order_max`, mm.
Series second_order(const RunReadings& run, std::size_t sensor, double sensitive_rad,
                    const PartInRun& part, int order_max);

}  // namespace trueaxis
