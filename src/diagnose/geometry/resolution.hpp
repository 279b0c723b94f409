// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/geometry/observation_mask.hpp"

namespace trueaxis::diagnose_detail {

/// What the sampling lets be seen.
struct Resolution {
  double per_turn = 0.0;     ///< readings a revolution of the slowest turning pass
  bool whole = false;        ///< a whole number of them: orders n and M − n are one column
  int harmonics = 0;         ///< highest order of the Fourier-Legendre basis
  int degrees = 0;           ///< highest Legendre degree along s
  double turns = 0.0;        ///< of all passes
  bool one_variable = true;  ///< C, Z and t are one: a single pass of constant speed and feed
  bool sections = false;     ///< Z steps from section to section
};
Resolution resolution_of(const LinearisationPoint& point, const ObservationMask& mask);

}  // namespace trueaxis::diagnose_detail
