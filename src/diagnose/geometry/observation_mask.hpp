// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"

namespace trueaxis::diagnose_detail {
/// Which readings count, and their blocks for cross-validation.
struct ObservationMask {
  std::vector<char> used;          ///< 0: masked
  std::vector<unsigned char> run;  ///< used readings just before, in unbroken sampling; at most 8
  std::vector<std::size_t> fold_begin;  ///< of contiguous blocks; one more than there are
  std::string block;                    ///< what a block is
  double alike_mm = 0.0;                ///< error that readings share, as if each had it alone

  std::size_t folds() const { return fold_begin.size() - 1; }
  void mask(std::size_t reading) { used[reading] = 0; }
  /// Counts `run` anew after masking.
  void find_runs(const LinearisationPoint& point);
};

/// All readings used; blocks are sections of constant Z where the probe steps from one to the next,
/// else about thirty groups of whole revolutions, none across a pass.
ObservationMask make_observation_mask(const LinearisationPoint& point);

/// What the sampling lets be seen.
struct Resolution {
  double per_turn = 0.0;     ///< readings per revolution of the slowest turning pass
  bool whole = false;        ///< a whole number of them: orders n and M − n are one column
  int harmonics = 0;         ///< highest order of the Fourier-Legendre basis
  int degrees = 0;           ///< highest Legendre degree along s
  double turns = 0.0;        ///< of all passes
  bool one_variable = true;  ///< C, Z and t are one: a single pass of constant speed and feed
  bool sections = false;     ///< Z steps from section to section
  bool sparse = false;       ///< few even angles in each of them, as hand probing gives
  int half_seen = 0;         ///< of M angles the order M/2, of which one phase shows; 0: none
};
Resolution resolution_of(const LinearisationPoint& point, const ObservationMask& mask);

}  // namespace trueaxis::diagnose_detail
