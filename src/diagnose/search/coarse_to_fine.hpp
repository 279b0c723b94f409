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
  /// @param whole outlives it, or what is asked next
  explicit CoarseToFineSearch(const Problem& whole);
  CoarseToFineSearch(const CoarseToFineSearch&) = delete;
  CoarseToFineSearch& operator=(const CoarseToFineSearch&) = delete;

  Model model;                                 ///< its noise is that of the readings
  Proposer& proposer() { return *proposer_; }  ///< of what was searched
  /// Proposes what else may explain a term of the model, about another place than was searched:
  /// over means again if that was. It takes the place of the one before.
  /// @param whole outlives it
  Proposer& about(const Problem& whole);
  const std::vector<double>& phi() const { return phi_; }  ///< noise of what was searched

 private:
  /// The means of a problem, less lines that are known, and a proposer for them.
  Proposer& over_means(const Problem& whole);
  void search_means(const Problem& whole);

  Means means_;
  std::vector<Hypothesis> known_, candidates_;  ///< fast lines that means would weaken
  std::vector<double> linear_;                  ///< sizes of what is known
  std::optional<LineScanner> scanner_;          ///< of the first means
  std::optional<Problem> problem_;              ///< over the means
  std::optional<Proposer> proposer_;            ///< of what was searched
  std::vector<double> phi_;
};

}  // namespace trueaxis::diagnose_detail
