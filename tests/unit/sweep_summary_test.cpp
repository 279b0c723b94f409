// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "study/sweep/files/sweep_results.hpp"
#include "study/sweep/summary.hpp"
#include "support/sweep_examples.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A face (l, m, d) whose errors in l are 1 … 10, in m 2 with one failure, in d unknown; u = 2.5.
struct Example {
  Sweep sweep;
  std::vector<BlockResult> results;

  Example() {
    sweep.base = testing::probed_part(virtual_lathe::PartKind::face);
    sweep.repeats = 10;
    BlockResult block;
    block.block = {0, 0, 10};
    block.quantities = 3;
    for (int i = 1; i <= 10; ++i) {
      const bool failed = i == 4;
      for (const double error : {1.0 * i, failed ? none : 2.0, none}) block.error.push_back(error);
      block.u.insert(block.u.end(), 3, 2.5);
      if (failed) ++block.failures;
    }
    block.why = "why it failed, \"quoted\"";
    block.facts.push_back({77, {0.1, 0.2, 0.3}, {Bound::Kind::cramer_rao, {5.0, none, 1.0}, {}}});
    results.push_back(block);
  }
};

TEST(Summary, IsThatOfTheErrorsByHand) {
  const Example example;
  const Summary summary = summarise(example.sweep, example.results);
  ASSERT_EQ(summary.rows.size(), 3U);
  const Row& l = summary.rows[0];
  EXPECT_EQ(l.truth, 0.1);
  EXPECT_EQ(l.estimates, 10U);
  EXPECT_DOUBLE_EQ(l.bias, 5.5);
  EXPECT_DOUBLE_EQ(l.sd, std::sqrt(82.5 / 9.0));  // Σ(i − 5.5)² = 82.5
  EXPECT_DOUBLE_EQ(l.u_bias, l.sd / std::sqrt(10.0));
  EXPECT_DOUBLE_EQ(l.rmse, std::sqrt(38.5));  // Σi² = 385
  EXPECT_DOUBLE_EQ(l.q05, 1.45);
  EXPECT_DOUBLE_EQ(l.q50, 5.5);
  EXPECT_DOUBLE_EQ(l.q95, 9.55);
  EXPECT_DOUBLE_EQ(l.ratio, std::sqrt(38.5) / 5.0);
  // χ² with 10 degrees of freedom: quantiles 3.24697 and 20.48318 (tables).
  EXPECT_NEAR(l.ratio_95.low, l.ratio * std::sqrt(10.0 / 20.48318), 1e-6);
  EXPECT_NEAR(l.ratio_95.high, l.ratio * std::sqrt(10.0 / 3.24697), 1e-6);
  EXPECT_EQ(l.at_bound, true);
  EXPECT_DOUBLE_EQ(l.coverage.value, 0.5);  // errors 1 … 5 within 2 × 2.5
  // Clopper-Pearson of 5 in 10: 0.18709, 0.81291 (tables).
  EXPECT_NEAR(l.coverage.ends_95.low, 0.18709, 1e-5);
  EXPECT_NEAR(l.coverage.ends_95.high, 0.81291, 1e-5);
  const Row& m = summary.rows[1];
  EXPECT_EQ(m.estimates, 9U);
  EXPECT_DOUBLE_EQ(m.sd, 0.0);
  EXPECT_TRUE(std::isnan(m.ratio));
  EXPECT_FALSE(m.at_bound.has_value());
  EXPECT_DOUBLE_EQ(m.coverage.ends_95.high, 1.0);
  EXPECT_EQ(summary.rows[2].estimates, 0U);
  EXPECT_TRUE(std::isnan(summary.rows[2].bias));
  EXPECT_EQ(summary.cells[0].failures, 1U);
  EXPECT_EQ(summary.cells[0].readings, 77U);
}

// If numbers are drawn: half the errors 1, half 3, so mean(e²) = 5 and mean(e⁴) = 41.
TEST(Summary, IntervalOfDrawnNumbersIsThatOfTheDeltaMethodByHand) {
  Example example;
  example.sweep.drawn = {{"x0", "part.x0_mm", Drawn::Kind::uniform, 0.0, 1.0}};
  BlockResult& block = example.results.front();
  block.facts.front().bound_spread = {0.01, 0.01, none};
  Summary few = summarise(example.sweep, example.results);
  EXPECT_TRUE(std::isnan(few.rows[0].ratio_95.low)) << "10 estimates";
  EXPECT_FALSE(few.rows[0].at_bound.has_value());

  example.sweep.repeats = block.block.count = 100;
  block.error.clear(), block.u.assign(300, 1.0);
  for (int i = 0; i < 100; ++i) {
    for (const double error : {i % 2 == 0 ? 1.0 : -3.0, i == 0 ? none : 1.0, 1.0})
      block.error.push_back(error);
  }
  const Summary summary = summarise(example.sweep, example.results);
  const Row& l = summary.rows[0];
  EXPECT_DOUBLE_EQ(l.ratio, std::sqrt(5.0) / 5.0);
  const double spread = (41.0 / 25.0 - 1.0) / 99.0 + 0.01;
  EXPECT_NEAR(l.ratio_95.high, l.ratio * std::exp(0.5 * 1.959964 * std::sqrt(spread)), 1e-6);
  EXPECT_NEAR(l.ratio_95.low, l.ratio * std::exp(-0.5 * 1.959964 * std::sqrt(spread)), 1e-6);
  // One row is tested: 1 % two-sided is 2.5758 standard deviations, 1/0.447 is far beyond.
  EXPECT_EQ(l.at_bound, false);
  EXPECT_TRUE(std::isnan(summary.rows[1].ratio_95.low)) << "99 estimates and no bound";
  EXPECT_TRUE(std::isnan(summary.rows[2].ratio_95.low)) << "a single draw";
  // A ratio 2.3 standard deviations from 1 is, one 4.6 from it is not.
  const double at = std::exp(0.5 * 2.3 * std::sqrt(spread));
  block.facts.front().bound.sd[0] = std::sqrt(5.0) / at;
  EXPECT_EQ(summarise(example.sweep, example.results).rows[0].at_bound, true);
  block.facts.front().bound.sd[0] = std::sqrt(5.0) / (at * at);
  EXPECT_EQ(summarise(example.sweep, example.results).rows[0].at_bound, false);
}

TEST(Summary, WantsEveryBlockOnce) {
  Example example;
  example.results.push_back(example.results.front());
  EXPECT_THROW(summarise(example.sweep, example.results), ContractViolation);
  example.results.clear();
  EXPECT_THROW(summarise(example.sweep, example.results), ContractViolation);
}

// Every line has as many cells as the head; what does not exist is an empty cell.
TEST(SweepCsv, IsTidy) {
  Example example;
  example.sweep.axes.push_back({"a, \"b\"", {{"x, y", {}}}});
  const Summary summary = summarise(example.sweep, example.results);
  for (const std::string& text :
       {sweep_csv(example.sweep, summary), sweep_timing_csv(example.sweep, summary)}) {
    std::istringstream lines(text);
    std::string line;
    std::size_t width = 0;
    while (std::getline(lines, line)) {
      if (line.starts_with('#')) continue;
      bool quoted = false;
      std::size_t cells = 1;
      for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) ++cells;
      }
      if (width == 0) width = cells;
      EXPECT_EQ(cells, width) << line;
      EXPECT_EQ(line.find("nan"), std::string::npos) << line;
    }
  }
  EXPECT_NE(sweep_csv(example.sweep, summary).find("\"a, \"\"b\"\"\""), std::string::npos);
}

}  // namespace
}  // namespace trueaxis::study
