// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/geometry/observation_mask.hpp"

namespace trueaxis::diagnose_detail {

/// A point of means of neighbouring readings: what is slow against the sampling is searched for
/// here, at a fraction of the cost and with the same power.
struct Condensed {
  LinearisationPoint point;
  ObservationMask mask;
  std::vector<double> deviation_mm;
};

/// How many neighbours a mean is of: 1 for streams of fewer than 60 000 readings, else as many as
/// leave 40 means a turn, so that the highest order of the Fourier-Legendre basis keeps 86 %
/// of its amplitude.
std::size_t condensation(const LinearisationPoint& point, const Resolution& resolution);

/// Means of `every` readings that count, of one pass and one unbroken sampling (Eq. 77).
Condensed condense(const LinearisationPoint& point, const ObservationMask& mask,
                   const std::vector<double>& deviation_mm, std::size_t every);

}  // namespace trueaxis::diagnose_detail
