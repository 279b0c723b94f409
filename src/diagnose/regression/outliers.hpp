// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::diagnose_detail {

/// Readings far from what the surface may be.
struct Outliers {
  ObservationMask mask;        ///< of the readings that count
  std::vector<Rejected> list;  ///< those that do not, and why
  bool jumped = false;         ///< about a smooth form fitted to all readings
  bool jumps = false;          ///< the residual still does: no noise does, so it is not explained
};

/// Readings farther than 8 robust σ from the surface with what `basis` lets it deviate by, and what
/// clings to them, until nothing changes. Where the readings jump, as at the edges of grooves,
/// which draw a fit to all of them, it begins at the two thirds that fit best.
/// @param all to search in @param moves_s when a step of the basis is: no jump (Eqs. 63, 63a)
Outliers find_outliers(const LinearisationPoint& point, std::span<const Hypothesis> basis,
                       std::span<const double> deviation_mm, const ObservationMask& all,
                       int threads = 1, double moves_s = std::numeric_limits<double>::quiet_NaN());

/// The two thirds of the readings that are nearest to the surface with what `basis` lets it deviate
/// by, fitted to them alone (least trimmed squares; Rousseeuw and Van Driessen 2006).
ObservationMask nearest_two_thirds(const LinearisationPoint& point,
                                   std::span<const Hypothesis> basis,
                                   std::span<const double> deviation_mm, const ObservationMask& all,
                                   int threads);

/// Masks as well one to three readings in a row as far from a model that was found: what it
/// explains hid them before.
/// @param left_mm readings less the model @returns those that are new
std::vector<Rejected> mask_far_from(const LinearisationPoint& point,
                                    const std::vector<double>& left_mm, ObservationMask& mask);

}  // namespace trueaxis::diagnose_detail
