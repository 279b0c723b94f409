// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "form/low_pass.hpp"

namespace trueaxis::form {

/// A local regression as rows of a banded matrix: at every place the value there of the polynomial
/// that fits best with Gaussian weights. Eq. 261.
class RegressionRows final : public LowPass {
 public:
  struct Kernel {
    double width;  ///< α or γ times the cut-off: weights exp(−π (d / width)²)
    int degree;    ///< 1 or 2
  };
  /// @param weight of each reading: its share of the trace, times what a robust filter leaves of it
  RegressionRows(const Trace& trace, const Kernel& kernel, std::span<const double> weight);

  std::vector<double> operator()(std::span<const double> value_mm) const override;

 private:
  void add_row(double at, const Kernel& kernel, std::span<const double> weight);

  std::vector<double> places_;  ///< of a closed trace three turns of it, the middle one its own
  std::size_t count_;
  bool closed_;
  std::vector<std::size_t> begin_, first_;  ///< of row i: in `weights_`, and in the places
  std::vector<double> weights_;
};

}  // namespace trueaxis::form
