// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trueaxis::diagnose_detail {

/// Columns of some readings as computed and as whitened, in aligned memory padded with zeros.
class WhiteColumns {
 public:
  /// @param history readings before the first that the others are predicted from
  /// @param rows at most
  WhiteColumns(std::size_t columns, std::size_t history, std::size_t rows);

  std::span<double* const> raw() const { return raw_column_; }
  /// y_i − Σ φ_j y_{i−j} of `rows` rows, the first of them after `lead` others.
  void whiten(const std::vector<double>& phi, std::size_t lead, std::size_t rows);
  /// A row that comes `run` readings after the first of its run, fewer than the order.
  void begin_run(const std::vector<double>& phi, std::size_t lead, std::size_t row,
                 std::size_t run);
  /// A row that does not count.
  void drop(std::size_t row);
  /// Those of `rows` rows, padded; the same again.
  std::span<const double* const> white(std::size_t rows);
  std::span<const double* const> white() const { return view_; }
  /// Leaves only what is whitened.
  void forget_raw();

 private:
  std::size_t history_;
  hwy::AlignedFreeUniquePtr<double[]> raw_, white_;
  std::vector<double*> raw_column_, white_column_;
  std::vector<const double*> view_;
};

}  // namespace trueaxis::diagnose_detail
