// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <iostream>

#include "support/sweep_examples.hpp"

/// Intervals of a sweep that draws numbers of the scenario anew for each repeat.
namespace trueaxis::study {
namespace {

using testing::probed_part;
using testing::run_all;

// A face is fitted linearly in its normal: RMSE / bound of infinitely many repeats is 1, and the
// share of sweeps whose 95 % interval holds it is binomial. The interval is slightly too wide (the
// first draws are in both means), by less than the binomial's own width at these sizes.
TEST(DrawnSweep, IntervalOfTheRatioCovers) {
  constexpr int sweeps = 300;
  constexpr double level = 0.001;
  Sweep sweep;
  sweep.base = probed_part(virtual_lathe::PartKind::face);
  sweep.base.plan.passes[0].end_mm = 16.0;
  sweep.drawn = {{"noise.sigma_mm", "noise.sigma_mm", Drawn::Kind::log_uniform, 0.002, 0.008}};
  sweep.repeats = 200;
  std::vector<int> hits(3, 0), at_bound(3, 0);
  for (int i = 0; i < sweeps; ++i) {
    sweep.seed = 20261121 + static_cast<std::uint64_t>(i);
    const Summary summary = summarise(sweep, run_all(sweep, 1));
    for (std::size_t q = 0; q < 3; ++q) {
      const Row& row = summary.rows[q];
      ASSERT_LT(row.ratio_95.low, row.ratio_95.high) << "seed " << sweep.seed;
      hits[q] += row.ratio_95.low <= 1.0 && 1.0 <= row.ratio_95.high ? 1 : 0;
      at_bound[q] += row.at_bound.value_or(false) ? 1 : 0;
    }
  }
  const boost::math::binomial covered(sweeps, 0.95);
  const double lowest = quantile(covered, level), highest = quantile(complement(covered, level));
  for (std::size_t q = 0; q < 3; ++q) {
    std::cout << "seeds from 20261121: " << hits[q] << " of " << sweeps << " intervals cover, "
              << at_bound[q] << " are at the bound\n";
    EXPECT_GE(hits[q], lowest) << q;
    EXPECT_LE(hits[q], highest) << q;
    // Each row is tested at 1 % / 3.
    const boost::math::binomial misses(sweeps, bonferroni_level / 3.0);
    EXPECT_LE(sweeps - at_bound[q], quantile(complement(misses, level))) << q;
  }
}

}  // namespace
}  // namespace trueaxis::study
