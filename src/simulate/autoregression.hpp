// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// Whether an impulse into ε_i = Σ φ_j ε_{i−j} + e_i dies out.
bool is_stationary(const std::vector<double>& phi);

/// The series ε_i = Σ φ_j ε_{i−j} + q e_i of standard deviation 1 from variates e of standard
/// deviation 1. That of the first order (`rho`) begins with a variate, one of `autoregression` runs
/// in until an impulse has died out.
class Autoregression {
 public:
  /// @throws InputError for an autoregression that is not stationary.
  explicit Autoregression(const Noise& noise);

  template <class Variate>
  double next(Variate&& variate) {
    for (; run_in_ > 0; --run_in_) step(variate());
    if (begun_) return step(variate());
    begun_ = true;
    return recent_.front() = variate();
  }

 private:
  double step(double variate) {
    double next = innovation_ * variate;
    for (std::size_t j = 0; j < recent_.size(); ++j) next += phi_[j] * recent_[j];
    std::shift_right(recent_.begin(), recent_.end(), 1);
    return recent_.front() = next;
  }

  std::vector<double> phi_, recent_;  ///< recent values, the newest first
  double innovation_ = 1.0;           ///< q
  std::size_t run_in_ = 0;
  bool begun_ = false;
};

}  // namespace trueaxis::virtual_lathe
