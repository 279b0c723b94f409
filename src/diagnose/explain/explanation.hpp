// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/refit/relinearised_fit.hpp"
#include "diagnose/search/coarse_to_fine.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// What the terms of a model are, how large they are, and what they do to the axis.
struct Explanation {
  std::vector<Finding> findings;            ///< in the order of the model
  std::vector<AmbiguousFinding> ambiguous;  ///< one per cause
  std::vector<Unexplained> unexplained;     ///< terms that no catalogued cause explains
  /// What dropped causes would do to the axis that fit the readings nearly as well, at a size that
  /// is improbable but possible.
  std::vector<AxisShare> improbable;
};

/// @param fit of the search's model
Explanation explain(CoarseToFineSearch& search, const RelinearisedFit& fit,
                    const std::optional<Timing>& timing);

/// The model with a rival cause in the place of a term that it all but excludes about the part: the
/// search named it about the ideal fit. None: every cause is in its own class.
std::optional<Model> with_likeliest_rival(const Model& model, const Explanation& explanation);

/// A cause that is more than 20 times as large as the largest size of every cause in its class;
/// empty: there is none. A cause whose size is not a length counts as possible, and so does a slip.
std::string implausible_size(const Diagnosis& diagnosis);

}  // namespace trueaxis::diagnose_detail
