// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::diagnose_detail {

/// Masks readings farther than 8 robust σ from the surface with what `basis` lets it deviate by,
/// and what clings to them, until nothing changes. Where the readings jump, as at the edges of
/// grooves, which draw a fit to all of them, it begins at the two thirds that fit best.
/// @returns why, a line a reading (Eqs. 63, 63a).
std::vector<Rejected> mask_outliers(const LinearisationPoint& point,
                                    std::span<const Hypothesis> basis,
                                    std::span<const double> deviation_mm, ObservationMask& mask,
                                    int threads = 1);

/// Masks as well one to three readings in a row as far from a model that was found: what it
/// explains hid them before.
/// @param left_mm readings less the model @returns those that are new
std::vector<Rejected> mask_far_from(const LinearisationPoint& point,
                                    const std::vector<double>& left_mm, ObservationMask& mask);

}  // namespace trueaxis::diagnose_detail
