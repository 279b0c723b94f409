// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <array>
#include <complex>
#include <cstddef>
#include <span>
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

/// Smallest even number 2^a 3^b 5^c that is at least `least`.
std::size_t smooth_even_size(std::size_t least);

/// X_k = Σ_j x_j exp(−2πi jk/n) of one length n = 2^a 3^b 5^c. It is done as a matrix of n1 × n2 in
/// four steps (Bailey 1990), some columns or rows at a time in the second cache.
class FastFourier {
 public:
  using Complex = std::complex<double>;

  explicit FastFourier(std::size_t n);

  std::size_t size() const { return n_; }

  /// What one thread works with; kept from one transform to the next.
  struct Workspace {
    std::array<hwy::AlignedFreeUniquePtr<double[]>, 4> batches;
    hwy::AlignedFreeUniquePtr<double[]> turned_real, turned_imaginary;
    hwy::AlignedFreeUniquePtr<Complex[]> result;
  };
  Workspace workspace() const;

  /// X, in the workspace until its next use. @param real, imaginary x, n long.
  std::span<const Complex> operator()(std::span<const double> real,
                                      std::span<const double> imaginary, Workspace& with) const;

 private:
  Complex root(std::size_t power) const;

  std::size_t n_, n1_, n2_;
  BatchFourier over_columns_, over_rows_;
  std::vector<Complex> fine_, coarse_;  ///< exp(−2πi m/n), m < n2; of its multiples
  std::vector<Complex> turns_;          ///< exp(−2πi c k1/n), c those of a batch
};

}  // namespace trueaxis
