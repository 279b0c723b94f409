// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/search/propose.hpp"

namespace trueaxis::diagnose_detail {

/// Terms that explain the readings instead of those of a model.
struct Otherwise {
  std::vector<Hypothesis> terms;
  double probability = 0.0;
};

/// A set of terms in addition to the surface.
struct Model {
  std::vector<Hypothesis> terms;
  std::vector<double> p_values;  ///< family-wise
  std::vector<double> phi;       ///< autoregression of the noise after them
  double criterion = 0.0;
  Family family;
  /// What would explain more than any term that may be taken, were its size one that can be.
  const Effect* impossible = nullptr;
  /// Of few angles the models that the readings do not tell from this one, the most probable first.
  std::vector<Otherwise> others;
};

/// Forward by the best hypothesis, backward, swapped and merged, until nothing changes; once with
/// catalogued causes first and, where a pattern did better on the way, once with patterns allowed:
/// the better of the two. Of few angles begun with lobes and local
/// forms of every kind: the best, and the others that may be.
Model search(Proposer& proposer);

}  // namespace trueaxis::diagnose_detail
