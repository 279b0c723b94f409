// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/resolution.hpp"

namespace trueaxis::diagnose_detail {

/// Fourier × Legendre basis of the part's angle, order 0 from degree 0 on. Of several set-ups also
/// of the spindle's angle; of several passes also × Legendre in time.
std::vector<Hypothesis> fourier_legendre_basis(const LinearisationPoint& point,
                                               const Resolution& resolution);

/// The few of its functions that tell the noise from what is not: all orders, degrees 0 and 1, and
/// order 0 up to degree 5; at most a third as many columns as readings.
std::vector<Hypothesis> small_fourier_legendre_basis(const LinearisationPoint& point,
                                                     const Resolution& resolution);

}  // namespace trueaxis::diagnose_detail
