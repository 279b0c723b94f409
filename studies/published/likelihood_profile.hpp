// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "study/sweep/summary.hpp"

namespace trueaxis::study {

/// A log-likelihood of one positive number: its maximum and the 95 % interval of the likelihood
/// ratio, 2 (highest − log-likelihood) ≤ χ²(1).
class LikelihoodProfile {
 public:
  /// Looks between `low` and `high` in equal steps of the logarithm, then closer.
  LikelihoodProfile(const std::function<double(double)>& log_likelihood, double low, double high);

  double best() const { return best_; }
  double highest() const { return highest_; }
  /// NaN at a side where it stays within the interval down or up to the end.
  Ends interval_95() const;

 private:
  std::function<double(double)> of_log_;
  double low_, high_;  ///< logarithms
  double best_ = 0.0, highest_ = 0.0;

  double crossing(double step) const;
};

}  // namespace trueaxis::study
