// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/geometry/condense.hpp"
#include "diagnose/search/propose.hpp"

namespace trueaxis::diagnose_detail {
/// A set of terms beside the surface.
struct Model {
  std::vector<Hypothesis> terms;
  std::vector<double> p_values;  ///< family-wise
  std::vector<double> phi;       ///< autoregression of the noise beside them
  double criterion = 0.0;
  Family family;
};

/// Forward by the best hypothesis, backward, swapped and merged, until nothing changes; once with
/// catalogued causes first and, where a pattern did better on the way, once with patterns allowed:
/// the better of the two.
Model search(Proposer& proposer);

/// Whether a line is left that means of so many readings would weaken: search all readings then.
bool fast_line_left(const Problem& problem, const Model& model, std::size_t means);

/// A search over means of neighbouring readings where there are very many, over all of them where
/// something is left that means would hide.
class CoarseToFineSearch {
 public:
  explicit CoarseToFineSearch(const Problem& whole);
  CoarseToFineSearch(const CoarseToFineSearch&) = delete;
  CoarseToFineSearch& operator=(const CoarseToFineSearch&) = delete;

  Model model;  ///< its noise is that of the readings
  /// What was searched, and the model with the noise of that.
  Proposer& proposer() { return *proposer_; }
  Model searched_model() const;

 private:
  Condensed means_;
  Resolution resolution_;
  std::optional<Problem> problem_;    ///< over the means
  std::optional<Proposer> proposer_;  ///< of what was searched
  std::vector<double> phi_;           ///< noise of what was searched
};

}  // namespace trueaxis::diagnose_detail
