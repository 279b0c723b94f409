// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/summary.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "study/bound/quantities.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double coverage_factor = 2.0;
constexpr double least_estimates = 100.0;  // for a mean of squares to be about normal

/// Linear between order statistics (Hyndman and Fan's type 7); reorders the values.
double quantile(std::vector<double>& values, double share) {
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), below, values.end());
  if (below + 1 == values.end()) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + (at - std::floor(at)) * (above - *below);
}

/// n (RMSE / bound)² of an efficient fit is χ² with n degrees of freedom.
Ends ratio_ends(double ratio, double n, double level) {
  const boost::math::chi_squared square(n);
  return {ratio * std::sqrt(n / boost::math::quantile(complement(square, 0.5 * level))),
          ratio * std::sqrt(n / boost::math::quantile(square, 0.5 * level))};
}

/// Where numbers are drawn the errors of a cell have different spreads and there is no χ². Delta
/// method on the logarithm: `spread` is the variance of mean(e²) over its square plus that of
/// mean(bound²). Few draws of the bound do not represent a wide distribution: with σ log-uniform
/// over 2 decades 92 % of the 95 % intervals cover, over 4 decades 88 %.
Ends drawn_ratio_ends(double ratio, double n, double spread, double level) {
  if (n < least_estimates || !std::isfinite(ratio) || !std::isfinite(spread)) return {none, none};
  const boost::math::normal normal;
  const double half =
      0.5 * boost::math::quantile(complement(normal, 0.5 * level)) * std::sqrt(spread);
  return {ratio * std::exp(-half), ratio * std::exp(half)};
}

/// Variance of mean(e²) over its square.
double mean_square_spread(const std::vector<double>& error) {
  const auto n = static_cast<double>(error.size());
  double squares = 0.0, fourths = 0.0;
  for (const double e : error) {
    squares += e * e / n;
    fourths += e * e * e * e / n;
  }
  return (fourths / (squares * squares) - 1.0) / (n - 1.0);
}

Share share_of(double hits, double n) {
  constexpr double level = 0.05;
  const auto beta = [](double a, double b, double p) {
    return boost::math::quantile(boost::math::beta_distribution<>(a, b), p);
  };
  return {hits / n,
          {hits == 0.0 ? 0.0 : beta(hits, n - hits + 1.0, 0.5 * level),
           hits == n ? 1.0 : beta(hits + 1.0, n - hits, 1.0 - 0.5 * level)}};
}

/// The errors of one quantity and their u, in order of repeat, without those that failed.
struct Sample {
  std::vector<double> error, u;
};

Sample sample_of(const std::vector<const BlockResult*>& blocks, std::size_t quantity) {
  Sample sample;
  for (const BlockResult* block : blocks) {
    for (std::size_t i = quantity; i < block->error.size(); i += block->quantities) {
      if (!std::isfinite(block->error[i])) continue;
      sample.error.push_back(block->error[i]);
      sample.u.push_back(block->u[i]);
    }
  }
  return sample;
}

void fill(Row& row, Sample sample) {
  const auto n = static_cast<double>(sample.error.size());
  row.estimates = sample.error.size();
  row.bias = row.u_bias = row.sd = row.rmse = row.q05 = row.q50 = row.q95 = none;
  row.ratio = row.mean_u = none;
  row.ratio_95 = {none, none};
  if (sample.error.empty()) return;
  double sum = 0.0, squares = 0.0, hits = 0.0, u = 0.0;
  for (std::size_t i = 0; i < sample.error.size(); ++i) {
    sum += sample.error[i];
    squares += sample.error[i] * sample.error[i];
    hits += std::abs(sample.error[i]) <= coverage_factor * sample.u[i] ? 1.0 : 0.0;
    u += sample.u[i];
  }
  row.bias = sum / n;
  row.rmse = std::sqrt(squares / n);
  double spread = 0.0;
  for (const double error : sample.error) spread += (error - row.bias) * (error - row.bias);
  if (n > 1.0) row.sd = std::sqrt(spread / (n - 1.0));
  row.u_bias = row.sd / std::sqrt(n);
  row.mean_u = u / n;
  if (std::isfinite(u)) row.coverage = share_of(hits, n);  // else nothing is stated of it
  row.q05 = quantile(sample.error, 0.05);
  row.q50 = quantile(sample.error, 0.50);
  row.q95 = quantile(sample.error, 0.95);
  if (!(row.bound > 0.0)) return;
  row.ratio = row.rmse / row.bound;
}

/// Without noise every repeat is the same: it has an error, and neither spread nor coverage.
void withhold_spread(Row& row) {
  constexpr double rounding = 1e-12;  // of the true value, or of 1 mm or degree
  row.u_bias = row.sd = row.q05 = row.q50 = row.q95 = row.mean_u = none;
  row.coverage = {};
  if (row.rmse < rounding * std::max(1.0, std::abs(row.truth))) row.bias = row.rmse = 0.0;
}

CellSummary cell_of(const std::vector<const BlockResult*>& blocks) {
  CellSummary cell;
  double found = 0.0, named = 0.0, looked = 0.0;
  for (const BlockResult* block : blocks) {
    cell.failures += block->failures;
    if (cell.why.empty()) cell.why = block->why;
    cell.seconds += block->seconds;
    looked += static_cast<double>(block->found.size());
    for (const std::uint8_t bits : block->found) {
      found += (bits & 1U) != 0 ? 1.0 : 0.0;
      named += (bits & 2U) != 0 ? 1.0 : 0.0;
    }
  }
  if (looked > 0.0) cell.found = share_of(found, looked);
  const CellFacts& facts = blocks.front()->facts.at(0);
  if (looked > 0.0 && facts.hidden > 0) cell.named = share_of(named, looked);
  cell.readings = facts.readings;
  cell.bound = facts.bound;
  return cell;
}

/// The blocks of every cell in order of repeat.
std::vector<std::vector<const BlockResult*>> sorted(const Sweep& sweep,
                                                    const std::vector<BlockResult>& results) {
  std::map<std::pair<std::size_t, std::size_t>, const BlockResult*> by_place;
  for (const BlockResult& result : results) {
    const bool first =
        by_place.emplace(std::pair(result.block.cell, result.block.first_repeat), &result).second;
    expects(first, "every block once");
  }
  std::vector<std::vector<const BlockResult*>> out(cell_count(sweep));
  for (const Block& block : blocks_of(sweep)) {
    const auto at = by_place.find({block.cell, block.first_repeat});
    expects(at != by_place.end() && at->second->block == block, "all blocks of the sweep");
    out[block.cell].push_back(at->second);
  }
  return out;
}

}  // namespace

Summary summarise(const Sweep& sweep, const std::vector<BlockResult>& results) {
  Summary summary;
  std::vector<double> spread;  // of every row's ratio², where numbers are drawn
  const std::vector<Quantity> names = compared_quantities(sweep);
  const auto cells = sorted(sweep, results);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    summary.cells.push_back(cell_of(cells[cell]));
    const CellFacts& facts = cells[cell].front()->facts.at(0);
    for (std::size_t i = 0; i < names.size(); ++i) {
      Row row;
      row.cell = cell;
      row.quantity = names[i].name;
      row.unit = names[i].unit;
      row.truth = facts.truth[i];
      row.bound = i < facts.bound.sd.size() ? facts.bound.sd[i] : none;
      const Sample sample = sample_of(cells[cell], i);
      fill(row, sample);
      if (facts.bound.missing == Bound::Missing::no_noise && sweep.drawn.empty())
        withhold_spread(row);
      spread.push_back(i >= facts.bound_spread.size()
                           ? none
                           : mean_square_spread(sample.error) + facts.bound_spread[i]);
      summary.rows.push_back(std::move(row));
    }
  }
  const auto ends = [&](std::size_t i, double level) {
    const Row& row = summary.rows[i];
    const auto n = static_cast<double>(row.estimates);
    if (!sweep.drawn.empty()) return drawn_ratio_ends(row.ratio, n, spread[i], level);
    return std::isfinite(row.ratio) ? ratio_ends(row.ratio, n, level) : Ends{none, none};
  };
  double tested = 0.0;
  for (std::size_t i = 0; i < summary.rows.size(); ++i) {
    summary.rows[i].ratio_95 = ends(i, 0.05);
    tested += std::isfinite(summary.rows[i].ratio_95.low) ? 1.0 : 0.0;
  }
  for (std::size_t i = 0; i < summary.rows.size(); ++i) {
    if (!std::isfinite(summary.rows[i].ratio_95.low)) continue;
    const Ends within = ends(i, bonferroni_level / tested);
    summary.rows[i].at_bound = within.low <= 1.0 && 1.0 <= within.high;
  }
  return summary;
}

}  // namespace trueaxis::study
