// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/inference.hpp"

namespace trueaxis::infer {

/// A measurement that might be taken.
struct Measure {
  std::string code, what;
  double minutes = 0.0;
};

/// The measurement to take for something that each raises from `before` to `after`, one entry each:
/// among those that make sure of it and raise it nearly as much as any, the fastest (Eq. 100); none
/// where none makes sure of it. @param nothing why not, in words
Separating choose(std::span<const Measure> measures, double before,
                  const std::vector<double>& after, double sure, const std::string& nothing);

/// What measurements raise in sum over all that is asked.
class Ranking {
 public:
  explicit Ranking(std::span<const Measure> measures)
      : measures_(measures), gains_(measures.size(), 0.0), after_(measures.size(), 0.0) {}

  /// One more question; only what makes sure of it counts as a gain.
  void count(double before, const std::vector<double>& after, double sure, double weight);

  bool any() const;                        ///< whether one of them gains
  std::vector<std::size_t> order() const;  ///< best first: of nearly the same gain the fastest
  /// Mean probability with the data at hand, and with a measurement.
  double before() const { return weights_ > 0.0 ? before_ / weights_ : 0.0; }
  double after(std::size_t measure) const {
    return weights_ > 0.0 ? after_[measure] / weights_ : 0.0;
  }

 private:
  std::span<const Measure> measures_;
  std::vector<double> gains_, after_;
  double weights_ = 0.0, before_ = 0.0;
};

}  // namespace trueaxis::infer
