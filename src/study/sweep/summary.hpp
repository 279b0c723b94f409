// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/sweep/block.hpp"

namespace trueaxis::study {

/// Ends of an interval.
struct Ends {
  double low = 0.0, high = 0.0;
};

/// A share of repeats with its 95 % interval (Clopper-Pearson); NaN where there is none.
struct Share {
  double value = std::numeric_limits<double>::quiet_NaN();
  Ends ends_95{value, value};
};

/// One quantity in one cell; errors are estimate − truth, in the quantity's edge unit. Numbers that
/// do not exist are NaN.
struct Row {
  std::size_t cell = 0;
  std::string quantity, unit;
  double truth = 0.0;
  std::size_t estimates = 0;  ///< repeats that gave the number; the others are failures
  double bias = 0.0, u_bias = 0.0;
  double sd = 0.0, rmse = 0.0;
  double q05 = 0.0, q50 = 0.0, q95 = 0.0;
  double bound = 0.0;
  double ratio = 0.0;  ///< RMSE / bound
  /// The interval of the ratio of infinitely many repeats: χ², or if numbers are drawn the delta
  /// method from 100 estimates on.
  Ends ratio_95;
  /// Whether a ratio of 1 is within the scatter, at 1 % over all rows (Bonferroni); if there is an
  /// interval.
  std::optional<bool> at_bound;
  Share coverage;  ///< of |error| ≤ U, k = 2
  double mean_u = 0.0;
};

struct CellSummary {
  std::size_t readings = 0;
  std::size_t failures = 0;
  std::string why;  ///< of the first failure
  Bound bound;
  Share found;  ///< of a diagnosis: any cause
  Share named;  ///< of a diagnosis: every hidden effect in a class; none where none is hidden
  double seconds = 0.0;  ///< of one thread
};

struct Summary {
  std::vector<CellSummary> cells;
  std::vector<Row> rows;  ///< cell by cell, in the order of quantities()

  std::span<const Row> rows_of(std::size_t cell) const {
    const std::size_t count = rows.size() / cells.size();
    return std::span(rows).subspan(cell * count, count);
  }
};

/// Probability that a row of efficient fits is reported not to be at its bound.
inline constexpr double bonferroni_level = 0.01;

/// From the results of all blocks, in any order. Does not depend on who ran them (Eq. 125).
/// @throws ContractViolation when a block is missing or there twice.
Summary summarise(const Sweep& sweep, const std::vector<BlockResult>& results);

}  // namespace trueaxis::study
