// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"

namespace trueaxis::diagnose_detail {

/// Readings after a play: each is of the place where X last took the play up, X(C', Z') − b/2 if X
/// grew there and + b/2 if it fell (play operator, Krasnosel'skii and Pokrovskii 1989; Eq. 53c).
/// X turns back where it stands still, so that to first order the place is that of every size near.
struct BehindPlay {
  std::vector<double> c_rad, z_mm, time_s;  ///< of the place, and when X was there
  std::vector<double> side;  ///< 1: X grew; −1: it fell; 0: it never took the play up
};

/// @param point about which X is as it is probed, one entry a reading
/// @param terms that X has in addition, with their sizes
BehindPlay behind_play(const LinearisationPoint& point, std::span<const Hypothesis> terms,
                       std::span<const double> linear, double play_mm);

}  // namespace trueaxis::diagnose_detail
