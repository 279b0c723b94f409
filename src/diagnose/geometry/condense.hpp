// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {

/// A stream of a few turns, each standing for its many neighbours: what is slow against them is
/// searched for here, at a fraction of the cost and with the same power.
struct Means {
  LinearisationPoint point;
  ObservationMask mask;
  std::vector<double> deviation_mm;

  /// What the readings of a pass are averaged over.
  struct Of {
    double turns = 0.0;          ///< 0: C stands still
    double sectors = 0.0;        ///< of a turn
    std::size_t neighbours = 1;  ///< where C stands still
  };
  std::vector<Of> of_pass;
  double sensed_mm = 0.0;  ///< farthest that what is sensed goes within a mean

  /// The frequencies in [low, high] of lines cos(2π f x − turns θ) of which a mean keeps 90 %.
  /// @param x column of the whole stream
  std::vector<Extent> kept(const LinearisationPoint& whole, PointColumn x, double turns,
                           Extent within) const;
};

/// Whether a search over means is worth its while: from 40 000 readings on.
bool is_condensed(const LinearisationPoint& point);

/// Means over sectors of a turn, 40 of them or one per reading, and over as many turns as leave 500
/// of them. They have the argument of the middle turn (Eq. 77). @param known terms that the means
/// hold as they are, however fast, with their linear parameters
Means condense(const LinearisationPoint& point, const ObservationMask& mask,
               std::span<const double> deviation_mm, std::span<const Hypothesis> known,
               std::span<const double> linear, bool sections, int threads = 1);

}  // namespace trueaxis::diagnose_detail
