// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

namespace trueaxis::diagnose_detail {

/// Which products are made of columns that are appended to others.
struct Appended {
  std::size_t before = 0;         ///< columns that are there already
  std::size_t together = 0;       ///< and those that are fitted with them
  std::vector<std::size_t> ends;  ///< of the groups after these that are judged one by one

  std::size_t columns() const { return ends.empty() ? together : ends.back(); }
};

/// Sums over readings of the products that columns appended to others have with those, with each
/// other where they are fitted together, and within a group that is judged alone.
class GramSums {
 public:
  /// @param of outlives this
  explicit GramSums(const Appended& of);

  /// Columns are those there and those appended, 64-byte aligned, padded as of a WideBlock.
  void add(std::span<const double* const> columns, std::size_t rows);
  /// Adds them to the rows and columns of a symmetric matrix of all columns.
  void add_to(Eigen::MatrixXd& gram) const;

 private:
  const Appended* of_;
  std::vector<double> fitted_, cross_, apart_, groups_;
};

}  // namespace trueaxis::diagnose_detail
