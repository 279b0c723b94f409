// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "math/golden_section.hpp"

namespace trueaxis::calibrate_detail {

/// Least squares of Legendre polynomials and orders of a period over scattered positions (Eq. 177).
class PeriodicFit {
 public:
  struct Result {
    /// Polynomials, the reversal value if senses are given, then cos and sin of every order.
    std::vector<double> coefficients, u;
    std::vector<double> gains;  ///< of each order: what leaving it out adds to the rss
    std::vector<double> residuals;
    double rss = 0.0, freedom = 0.0;
  };

  /// @param smooth polynomials at most, degree 0 first: 4, of what repeats itself 1
  /// @param sense of the approach, +0.5 or −0.5 for each position; empty: all alike
  PeriodicFit(std::vector<double> position, std::vector<double> value, std::size_t smooth = 4,
              std::vector<double> sense = {});

  const std::vector<double>& position() const { return position_; }
  std::size_t smooth() const { return smooth_; }  ///< polynomials: degree 3 at most, plus one
  bool has_senses() const { return !sense_.empty(); }
  std::size_t first_order() const { return smooth_ + (has_senses() ? 1 : 0); }  ///< coefficient
  Result with(const std::vector<int>& orders, double period) const;
  /// 1 … `most`, as far as the positions are dense enough and there are readings for them.
  std::vector<int> orders_up_to(int most, double period, double highest_frequency) const;

 private:
  std::vector<double> position_, value_, sense_;
  std::size_t smooth_;
};

/// Where a function of one valley is least.
template <class Function>
double least_of(const Function& f, double low, double high) {
  const GoldenSection found = golden_section([&](double x) { return -f(x); }, low, high, 30);
  return 0.5 * (found.low + found.high);
}

}  // namespace trueaxis::calibrate_detail
