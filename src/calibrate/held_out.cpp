// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "calibrate/explain.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_blocks = 8;
constexpr double t_95[] = {12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36};  // 1 … 7 degrees of freedom

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

HeldOutRms held_out(const Problem& problem, const MatrixXd& columns, const VectorXd& readings) {
  HeldOutRms out;
  const std::vector<std::size_t> block_of_row = blocks_of(problem, out.blocks);
  if (out.blocks < 2) return out;
  const MatrixXd normal = linear::gram(columns);
  const VectorXd right = linear::transposed_product(columns, readings);
  std::vector<double> mean_square;
  double sum = 0.0;
  for (std::size_t block = 0; block < out.blocks; ++block) {
    std::vector<Index> held;
    double sigma2 = 0.0;
    for (std::size_t i = 0; i < problem.rows.size(); ++i) {
      if (block_of_row[i] != block) continue;
      const Row& row = problem.rows[i];
      for (Index k = 0; k < row.equations(); ++k) held.push_back(row.first + k);
      sigma2 += static_cast<double>(row.equations()) * row.sigma_mm * row.sigma_mm;
    }
    const MatrixXd own = columns(held, Eigen::all);
    const VectorXd read = readings(held);
    const MatrixXd rest = normal - linear::gram(own);
    const VectorXd x =
        linear::least_squares(rest, VectorXd(right - linear::transposed_product(own, read)));
    // Over σ here; mm by the mean σ of the block.
    const double n = static_cast<double>(held.size());
    mean_square.push_back((read - own * x).squaredNorm() / n * sigma2 / n);
    sum += mean_square.back();
  }
  const auto m = static_cast<double>(out.blocks);
  const double mean = sum / m;
  double spread = 0.0;
  for (const double one : mean_square) spread += (one - mean) * (one - mean);
  const double u = std::sqrt(spread / (m * (m - 1.0))) * t_95[out.blocks - 2];
  out.rms = {std::sqrt(mean), std::sqrt(std::max(0.0, mean - u)), std::sqrt(mean + u)};
  return out;
}

}  // namespace trueaxis::calibrate_detail
