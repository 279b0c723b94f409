// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A finding with everything that explains it as well: the named cause first.
struct ConfounderSet {
  std::vector<Candidate> members;
  std::vector<Rival> rivals;  ///< one per member but the first
  double probability = 1.0;   ///< of the first
};

/// The class of term i of a model. A rival belongs to it when its best fit is nearer to the named
/// prediction than d with Φ(d/2) = 0.95, or when the data's own likelihood ratio does not tell.
ConfounderSet distinguish(const Problem& problem, const Model& model, std::size_t term);

/// The class of a lag or a delay with what the second order says: −2 ln of the likelihood of the
/// other over that of the named one.
void narrow(ConfounderSet& found, double likelihood_ratio);

}  // namespace trueaxis::diagnose_detail
