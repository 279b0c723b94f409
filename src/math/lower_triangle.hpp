// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <span>

namespace trueaxis {

/// The lower triangle of a symmetric matrix, column by column in aligned memory. What is above the
/// diagonal is finite and of no meaning.
class LowerTriangle {
 public:
  /// All 0.
  explicit LowerTriangle(std::size_t size);

  std::size_t size() const { return size_; }
  std::size_t stride() const { return stride_; }  ///< a multiple of 8
  double* column(std::size_t j) { return memory_.get() + j * stride_; }
  const double* column(std::size_t j) const { return memory_.get() + j * stride_; }
  /// Entry i, j ≤ i.
  double& operator()(std::size_t i, std::size_t j) { return column(j)[i]; }
  double operator()(std::size_t i, std::size_t j) const { return column(j)[i]; }

  /// Becomes Σ factor · part, in the order given.
  struct Part {
    double factor;
    const LowerTriangle* of;
  };
  void become_sum(std::span<const Part> parts);

  /// Takes the first `count` columns out of all others, of which the Schur complement remains. The
  /// first ones become the Cholesky factor, whose rows below are R⁻ᵀ times the products of the
  /// others with them. @returns false where the first columns are not positive definite
  bool eliminate(std::size_t count);

 private:
  std::size_t size_, stride_;
  hwy::AlignedFreeUniquePtr<double[]> memory_;
};

}  // namespace trueaxis
