// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "math/column_source.hpp"

namespace trueaxis {

/// Fourier sums of values at irregular abscissae t,
///   F_k = Σ_i w_i exp(−i (w0 + k dw) t_i), k = 0 … K−1, by a non-uniform fast transform of type 1
///   (Dutt and Rokhlin 1993). The kernel exp(β(√(1 − x²) − 1)) of Barnett, Magland and af
///   Klinteberg (2019) spreads every value over 12 points of a grid twice as fine as needed. The
///   grid is transformed, and divided by the kernel's own transform.
/// Error of F_k: at most 1e-9 Σ|w_i|, for phases (w0 + k dw) t below 1e9 rad. The units of t and
/// w0, dw are free but inverse to each other.
///
/// The object keeps 16 bytes per order k, and for few readings what depends on t alone; for many it
/// is made anew, some thousands at a time. `of` works with about 110 bytes an order. Fastest for t
/// nearly in order. Copies share it; `of` may be called from several threads.
class FourierSums {
 public:
  using Sums = std::vector<std::complex<double>>;

  /// @param t outlives this
  /// @throws ContractViolation unless 1 ≤ K ≤ 2^28 and everything is finite.
  FourierSums(std::span<const double> t, double w0, double dw, std::size_t K);
  /// @param t of `size` readings, all finite
  /// @param middle about that of t: what it is counted from
  FourierSums(ColumnSource t, std::size_t size, double middle, double w0, double dw, std::size_t K);

  std::size_t orders() const;

  /// F_0 … F_{K−1} of values as long as t.
  Sums of(std::span<const double> w) const;
  /// The same for several columns over the same t, each with the bits it has alone; cheaper
  /// together.
  std::vector<Sums> of(std::span<const std::span<const double>> w) const;
  /// The same of `count` columns that are made where they are asked for.
  std::vector<Sums> of(const ColumnSource& w, std::size_t count) const;

 private:
  struct Places;
  struct Spreading;
  std::shared_ptr<const Spreading> spreading_;
};

}  // namespace trueaxis
