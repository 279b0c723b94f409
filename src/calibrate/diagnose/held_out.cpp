// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "calibrate/diagnose/explain.hpp"
#include "infer/cross_validation.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_blocks = 30;

/// The block of every row: rotary positions in the order in which they came, cut into blocks.
std::vector<std::size_t> blocks_of(const Problem& problem, std::size_t& count) {
  using Rotary = std::array<double, 3>;
  std::vector<Rotary> different;
  std::vector<std::size_t> place;
  for (const Row& row : problem.rows) {
    const Rotary at{row.axes[3], row.axes[4], row.axes[5]};
    const auto found = std::ranges::find(different, at);
    place.push_back(static_cast<std::size_t>(found - different.begin()));
    if (found == different.end()) different.push_back(at);
  }
  count = std::min(most_blocks, different.size());
  for (std::size_t& one : place) one = one * count / different.size();
  return place;
}

}  // namespace

void hold_out(const Problem& problem, const MatrixXd& columns, Index base, const VectorXd& readings,
              MachineDiagnosis& out) {
  const std::vector<std::size_t> block_of_row = blocks_of(problem, out.blocks);
  if (out.blocks < 2) return;
  MatrixXd all(columns.rows(), columns.cols() + 1);
  all << readings, columns;
  infer::Columns before(static_cast<std::size_t>(base)),
      after(static_cast<std::size_t>(columns.cols()));
  std::iota(before.begin(), before.end(), 1U);
  std::iota(after.begin(), after.end(), 1U);
  std::vector<infer::Fold> folds;
  for (std::size_t block = 0; block < out.blocks; ++block) {
    std::vector<Index> held;
    double sigma2 = 0.0;
    for (std::size_t i = 0; i < problem.rows.size(); ++i) {
      if (block_of_row[i] != block) continue;
      const Row& row = problem.rows[i];
      for (Index k = 0; k < row.equations(); ++k) held.push_back(row.first + k);
      sigma2 += static_cast<double>(row.equations()) * row.sigma_mm * row.sigma_mm;
    }
    const MatrixXd own = all(held, Eigen::all);
    const auto n = static_cast<double>(held.size());
    // Over σ here; mm by the mean σ of the block.
    folds.push_back({linear::gram(own), n, sigma2 / n});
  }
  infer::cross_validate(linear::gram(all), folds, before, after, out.gain);
}

}  // namespace trueaxis::calibrate_detail
