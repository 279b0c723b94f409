// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/geometry/condense.hpp"
#include "diagnose/search/search.hpp"

namespace trueaxis::diagnose_detail {

/// A search over means of neighbouring readings where there are very many, over all of them where
/// something is left that means would hide.
class CoarseToFineSearch {
 public:
  explicit CoarseToFineSearch(const Problem& whole);

  Model model;  ///< its noise is that of the readings
  ConfounderSet distinguish(std::size_t term) const;

 private:
  const Problem& whole_;
  Condensed means_;
  Resolution resolution_;
  std::optional<Problem> problem_;  ///< over the means
  std::vector<double> phi_;         ///< noise of what was searched
};

}  // namespace trueaxis::diagnose_detail
