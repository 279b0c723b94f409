// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/search/fourier_legendre_basis.hpp"

namespace trueaxis::diagnose_detail {

/// Every variant of the catalogue without a line to scan for: what is tried one by one in every
/// step. `tests` of each is how many of its kind there are. Harmonics in the part's frame stand for
/// all of their order until rivals_of_order tells them apart, unless re-chucking does.
std::vector<Hypothesis> preset_causes(const LinearisationPoint& point,
                                      const Resolution& resolution);

/// Causes that show as the harmonic of an order: of part, chuck, spindle and encoder.
std::vector<Hypothesis> causes_of_order(const LinearisationPoint& point,
                                        const Resolution& resolution, int order);

/// The range of what the probe has sensed, on the side where it is larger: from side to side
/// nothing is read.
double sensed_swing(const LinearisationPoint& point);
constexpr double least_swing_mm = 0.02;  ///< below it no period of the scale is seen

/// A slip at every one of some instants.
std::vector<Hypothesis> slips(const LinearisationPoint& point, std::size_t instants);

/// Neighbours of a hypothesis in its continuous shape (bearing, decay length, onset, time constant,
/// window of a bump), `step` apart on a scale where 1 is the range; lines are refined elsewhere.
std::vector<Hypothesis> neighbours(const Hypothesis& hypothesis, const LinearisationPoint& point,
                                   double step);

}  // namespace trueaxis::diagnose_detail
