// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regression/joint.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {
/// A cause with everything that fits the readings equally well: the named cause first (Eq. 87).
struct ConfounderSet {
  std::vector<Candidate> members;
  std::vector<Rival> rivals;  ///< one per member but the first
  /// The size of each member, in spreads of its prior about the median; 0: it has none.
  std::vector<double> spreads;
  double probability = 1.0;  ///< of the first
  /// What is dropped: as too improbable, or told apart only as far as it is linear in its size.
  struct Dropped {
    Candidate cause;
    double probability = 0.0;
    bool told = false;
  };
  std::vector<Dropped> dropped;
};

/// A term of the model with the class it was found to be one of.
struct AmbiguousFinding {
  std::size_t term = 0;
  ConfounderSet found;
};

/// The class of a term of the model that was searched. A rival cause belongs to it if its best fit
/// is nearer to the named prediction than d with Φ(d/2) = 0.95. So it does if the data's own
/// likelihood ratio does not tell (Eqs. 87–93). May be asked by several threads. @param proposer
/// prepared for the noise of the model
ConfounderSet distinguish(const Proposer& proposer, const Model& model, std::size_t term,
                          int threads);

/// The class of one of two effects that are one in the first order with what the second order says:
/// 2 ln of the likelihood of the named one over that of the other (Eq. 94).
void narrow(ConfounderSet& found, double twice_log_ratio);

}  // namespace trueaxis::diagnose_detail
