// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"

namespace trueaxis::diagnose_detail {

/// What the sampling lets be seen.
struct Resolution {
  double per_turn = 0.0;     ///< readings a revolution of the slowest turning pass
  bool whole = false;        ///< a whole number of them: orders n and M − n are one column
  int harmonics = 0;         ///< highest order of the fourier_legendre_basis
  int degrees = 0;           ///< highest Legendre degree along s
  double turns = 0.0;        ///< of all passes
  bool one_variable = true;  ///< C, Z and t are one: a single pass of constant speed and feed
  bool sections = false;     ///< Z steps from section to section
};
Resolution resolution_of(const LinearisationPoint& point, const ObservationMask& mask);

/// Fourier × Legendre basis of the part's angle, order 0 from degree 0 on. Of several set-ups also
/// of the spindle's angle; of several passes also × Legendre in time.
std::vector<Hypothesis> fourier_legendre_basis(const LinearisationPoint& point,
                                               const Resolution& resolution);

/// The few basis that tell the noise from what is not: all orders, degrees 0 and 1, and order 0 up
/// to degree 5; at most a third as many columns as readings.
std::vector<Hypothesis> small_fourier_legendre_basis(const LinearisationPoint& point,
                                                     const Resolution& resolution);

}  // namespace trueaxis::diagnose_detail
