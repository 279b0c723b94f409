// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <complex>
#include <cstddef>
#include <vector>

namespace trueaxis {

/// Transforms of one length n = 2^a 3^b 5^c, `batch` of them side by side:
/// X_k = Σ_j x_j exp(−2πi jk/n), by radices 4, 2, 3 and 5 in the order of Stockham (1966).
class BatchFourier {
 public:
  static constexpr std::size_t batch = 8;

  explicit BatchFourier(std::size_t n);

  std::size_t size() const { return roots_.size(); }

  /// Value j of transform b at j · batch + b; 64-byte aligned.
  struct Values {
    double *real, *imaginary;
  };
  /// @param other room for as many
  /// @returns whichever of the two holds X
  Values operator()(Values x, Values other) const;

 private:
  std::vector<std::size_t> radices_;
  std::vector<std::complex<double>> roots_;  ///< exp(−2πi m/n)
};

}  // namespace trueaxis
