// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <complex>
#include <cstddef>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace trueaxis {

/// Smallest even number 2^a 3^b 5^c that is at least `least`.
std::size_t smooth_even_size(std::size_t least);

/// X_k = Σ_j x_j exp(−2πi jk/n) of one length n = 2^a 3^b 5^c (Eigen's kissfft). A long transform
/// is done as a matrix of n1 × n2 in four steps (Bailey 1990), each in the second cache.
class FastFourier {
 public:
  using Complex = std::complex<double>;

  explicit FastFourier(std::size_t n);

  std::size_t size() const { return n_; }

  /// What one thread works with; kept from one transform to the next.
  struct Workspace {
    hwy::AlignedFreeUniquePtr<Complex[]> in, out, turned, result;
    Eigen::FFT<double> plan;
  };
  Workspace workspace() const;

  /// X, in the workspace until its next use. @param real, imaginary x, n long.
  std::span<const Complex> operator()(std::span<const double> real,
                                      std::span<const double> imaginary, Workspace& with) const;

 private:
  void in_four_steps(std::span<const double> real, std::span<const double> imaginary,
                     Workspace& with) const;
  Complex root(std::size_t power) const;

  std::size_t n_, n1_ = 1, n2_;
  std::vector<Complex> fine_, coarse_;  ///< exp(−2πi m/n), m < root_step; of its multiples
  Eigen::FFT<double> plan_;             ///< holds the roots of the lengths n1, n2
};

}  // namespace trueaxis
