// SPDX-License-Identifier: Apache-2.0
#include "infer/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace trueaxis::infer {
namespace {

constexpr int resamplings = 999;

/// Sums of squares of a block, predicted by two models.
struct HeldOutBlock {
  double before = 0.0, after = 0.0, rows = 0.0;
};

/// Percentiles of a statistic over resampled blocks .
template <typename Statistic>
Interval interval(std::span<const HeldOutBlock> blocks, Statistic statistic) {
  const auto sum = [](std::span<const HeldOutBlock> list) {
    HeldOutBlock all;
    for (const HeldOutBlock& b : list)
      all.before += b.before, all.after += b.after, all.rows += b.rows;
    return all;
  };
  Interval out;
  out.value = statistic(sum(blocks));
  std::mt19937_64 random(20261121);
  std::vector<double> values;
  std::vector<HeldOutBlock> drawn(blocks.size());
  for (int r = 0; r < resamplings; ++r) {
    for (HeldOutBlock& b : drawn) b = blocks[random() % blocks.size()];
    values.push_back(statistic(sum(drawn)));
  }
  std::ranges::sort(values);
  out.low = values[static_cast<std::size_t>(0.025 * resamplings)];
  out.high = values[static_cast<std::size_t>(0.975 * resamplings)];
  return out;
}

}  // namespace

void cross_validate(const Eigen::MatrixXd& total, std::span<const Fold> folds,
                    const Columns& before, const Columns& after, Explained& out) {
  std::vector<HeldOutBlock> blocks;
  for (const Fold& fold : folds) {
    const auto sum = [&](const Columns& columns) {
      return fold.unit2 * std::max(0.0, held_out(total, fold.gram, columns));
    };
    blocks.push_back({sum(before), sum(after), fold.rows});
  }
  if (blocks.empty()) return;
  out.held_out_before_mm =
      interval(blocks, [](const HeldOutBlock& b) { return std::sqrt(b.before / b.rows); });
  out.held_out_after_mm =
      interval(blocks, [](const HeldOutBlock& b) { return std::sqrt(b.after / b.rows); });
  out.held_out_ratio = interval(blocks, [](const HeldOutBlock& b) {
    return b.before > 0.0 ? std::sqrt(b.after / b.before) : 1.0;
  });
}

}  // namespace trueaxis::infer
