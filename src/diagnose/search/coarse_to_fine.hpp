// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnose/geometry/condense.hpp"
#include "diagnose/search/search.hpp"

namespace trueaxis::diagnose_detail {

/// A search over means where there are very many readings. The search looks for lines that means
/// would weaken in all readings. If there are some, it makes the means after them, and searches
/// again.
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
  void search_means(const Problem& whole);

  Means means_;
  std::optional<Problem> problem_;    ///< over the means
  std::optional<Proposer> proposer_;  ///< of what was searched
  std::vector<double> phi_;           ///< noise of what was searched
};

}  // namespace trueaxis::diagnose_detail
