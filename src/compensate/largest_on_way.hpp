// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "math/golden_section.hpp"

namespace trueaxis {

inline constexpr double stated_to = 1.01;  ///< a deviation is stated to a hundredth

/// The largest of a function on [0, 1], by `count` + 1 even points (2 or more parts). If the
/// largest can be above `of_interest`, the search goes on next to each point that is a peak and
/// within a tenth of the largest. There the vertex of the parabola through three points is asked;
/// where the function is not what the parabola says, golden section finds the peak to 1e-5 of two
/// parts.
template <class Of>
class LargestOnWay {
 public:
  LargestOnWay(const Of& of, std::size_t count) : of_(of), part_(1.0 / static_cast<double>(count)) {
    for (std::size_t i = 0; i <= count; ++i) at_.push_back(of(static_cast<double>(i) * part_));
  }

  double value(double of_interest) const {
    double largest = *std::max_element(at_.begin(), at_.end());
    double bow = 0.0;  // twice what a parabola through three points rises above them
    for (std::size_t i = 1; i + 1 < at_.size(); ++i)
      bow = std::fmax(bow, 0.25 * std::fabs(second_difference(i)));
    if (!(largest + bow > of_interest)) return largest;
    const double worth_a_look = 0.9 * largest;
    for (std::size_t i = 0; i < at_.size(); ++i)
      if (at_[i] >= worth_a_look && is_peak(i)) largest = std::fmax(largest, beside(i));
    return largest;
  }

 private:
  double second_difference(std::size_t i) const { return at_[i - 1] - 2.0 * at_[i] + at_[i + 1]; }
  bool is_peak(std::size_t i) const {
    return (i == 0 || at_[i] >= at_[i - 1]) && (i + 1 == at_.size() || at_[i] >= at_[i + 1]);
  }

  double beside(std::size_t peak) const {
    const std::size_t i = std::clamp<std::size_t>(peak, 1, at_.size() - 2);
    const double bend = second_difference(i), s = static_cast<double>(i) * part_;
    if (!(bend < 0.0)) return at_[peak];
    const double slope = 0.5 * (at_[i + 1] - at_[i - 1]), vertex = -slope / bend;
    if (std::fabs(vertex) <= 1.0) {
      const double there = of_(s + vertex * part_);
      if (std::fabs(there - (at_[i] + 0.5 * slope * vertex)) <= 0.01 * std::fabs(bend))
        return std::fmax(at_[peak], there);
    } else if (peak != i) {
      return at_[peak];  // it falls from the end on
    }
    return golden_section(of_, s - part_, s + part_, 24).largest;
  }

  const Of& of_;
  double part_;
  std::vector<double> at_;
};

}  // namespace trueaxis
