// SPDX-License-Identifier: Apache-2.0
#include "studies/published/placement.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "base/number.hpp"
#include "studies/published/likelihood_profile.hpp"
#include "studies/published/printed_run.hpp"
#include "study/bound/quantities.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double least_factor = 1e-3, most_factor = 1e2;

double p_of(double chi_squared, double degrees) {
  return boost::math::cdf(complement(boost::math::chi_squared(degrees), chi_squared));
}

/// What all readings of a table share.
struct Table {
  const Sweep& sweep;
  const Published& published;
  std::map<std::size_t, const CellFacts*> facts;  ///< by cell
  std::vector<std::size_t> quantity;              ///< of every published parameter

  std::size_t cell_of(const PublishedRow& row) const { return row.grid * sweep.methods.size(); }
};

/// A reading with the runs it makes of the rows, in their order.
struct Understood {
  std::size_t reading = 0;
  std::vector<PrintedRun> runs;

  double log_likelihood(const std::vector<PublishedRow>& rows, double factor) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!rows[i].unknown_axis) sum += runs[i].at(factor).log_likelihood;
    }
    return sum;
  }
};

Understood understood(const Table& table, std::size_t index) {
  const PublishedReading& reading = table.published.readings[index];
  Sweep sweep = table.sweep;
  sweep.settings = reading.settings;
  Understood out{index, {}};
  for (const PublishedRow& row : table.published.rows) {
    const std::size_t cell = table.cell_of(row);
    const CellFacts& facts = *table.facts.at(cell);
    const Bound bound = reading.settings.empty()
                            ? facts.bound
                            : bound_of(scenario_of(sweep, cell), fitted_surface(sweep));
    out.runs.push_back(printed_run(row, reading, table.quantity, facts.truth, bound));
  }
  return out;
}

PlacedReading placed(const Table& table, const Understood& one) {
  const std::vector<PublishedRow>& rows = table.published.rows;
  const PublishedReading& reading = table.published.readings[one.reading];
  PlacedReading out;
  out.noise_factor = reading.noise_factor;
  out.noise_factor_95 = {none, none};
  if (reading.fit_noise) {
    const LikelihoodProfile profile([&](double factor) { return one.log_likelihood(rows, factor); },
                                    least_factor, most_factor);
    out.noise_factor = profile.best();
    out.noise_factor_95 = profile.interval_95();
  }
  double degrees = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].unknown_axis) continue;
    const auto parameters = static_cast<double>(one.runs[i].error.size());
    const PrintedRun::Likelihood at = one.runs[i].at(out.noise_factor);
    PlacedRow row{i,   one.runs[i].error, one.runs[i].in_sd(out.noise_factor), at.chi_squared,
                  0.0, at.log_likelihood};
    row.p_value = p_of(at.chi_squared, parameters);
    out.chi_squared += at.chi_squared;
    out.log_likelihood += at.log_likelihood;
    degrees += parameters;
    out.rows.push_back(std::move(row));
  }
  out.p_value = degrees > 0.0 ? p_of(out.chi_squared, degrees) : none;
  return out;
}

/// The level at the first point of the row's axis, and the others, in its path's unit.
std::vector<double> levels(const Sweep& sweep, std::size_t axis) {
  std::vector<double> out;
  for (const AxisPoint& point : sweep.axes[axis].points)
    out.push_back(point.settings.front().value);
  return out;
}

/// What a label of 1 is in the path's unit; 1 where the labels are words.
double unit_of(const GridAxis& axis) {
  const AxisPoint& first = axis.points.front();
  double label = 0.0;
  return parse_number(first.label, label) && label > 0.0 ? first.settings.front().value / label
                                                         : 1.0;
}

UnknownLevel level_of(const Table& table, const Understood& one, std::size_t row) {
  const std::vector<PublishedRow>& rows = table.published.rows;
  const PublishedReading& reading = table.published.readings[one.reading];
  const std::vector<double> known = levels(table.sweep, *rows[row].unknown_axis);
  const PrintedRun& run = one.runs[row];
  const auto of_level = [&](double level) {
    const double over_first = level / known.front();
    if (!reading.fit_noise) return run.at(reading.noise_factor * over_first).log_likelihood;
    return LikelihoodProfile(
               [&](double factor) {
                 return one.log_likelihood(rows, factor) +
                        run.at(factor * over_first).log_likelihood;
               },
               least_factor, most_factor)
        .highest();
  };
  const LikelihoodProfile profile(of_level, 0.01 * known.front(), 1e3 * known.front());
  UnknownLevel out{row,
                   one.reading,
                   unit_of(table.sweep.axes[*rows[row].unknown_axis]),
                   profile.best(),
                   profile.interval_95(),
                   {}};
  for (const double level : known)
    out.points.push_back({level, profile.highest() - of_level(level)});
  return out;
}

AmongRepeats among(const Table& table, const Understood& plain, std::size_t row,
                   const std::vector<BlockResult>& results) {
  const PublishedRow& published = table.published.rows[row];
  const PrintedRun& run = plain.runs[row];
  const std::size_t cell = table.cell_of(published), count = run.error.size();
  const double factor = table.published.readings.front().noise_factor;
  const double chi_squared = run.at(factor).chi_squared;
  AmongRepeats out{row, cell, std::vector<double>(count, 0.0), 0.0};
  double repeats = 0.0;
  for (const BlockResult& block : results) {
    if (block.block.cell != cell) continue;
    for (std::size_t r = 0; r < block.block.count; ++r) {
      std::vector<double> error(count);
      for (std::size_t i = 0; i < count; ++i)
        error[i] = run.as_printed(i, block.error[r * block.quantities + table.quantity[i]]);
      if (std::ranges::any_of(error, [](double e) { return !std::isfinite(e); })) continue;
      repeats += 1.0;
      for (std::size_t i = 0; i < count; ++i) {
        const double beyond = run.error[i] - error[i];
        const bool same = std::abs(beyond) < 0.25 * run.step[i];
        out.share_below[i] += same ? 0.5 : beyond > 0.0 ? 1.0 : 0.0;
      }
      if (run.of(error, factor).chi_squared >= chi_squared) out.share_as_far += 1.0;
    }
  }
  for (double& share : out.share_below) share = repeats > 0.0 ? share / repeats : none;
  out.share_as_far = repeats > 0.0 ? out.share_as_far / repeats : none;
  return out;
}

Table table_of(const Sweep& sweep, const Published& published,
               const std::vector<BlockResult>& results) {
  Table table{sweep, published, {}, {}};
  for (const BlockResult& block : results) {
    if (!block.facts.empty()) table.facts[block.block.cell] = &block.facts.front();
  }
  const std::vector<Quantity> all = quantities(fitted_surface(sweep));
  for (const std::string& name : table.published.parameters) {
    const auto at = std::ranges::find(all, name, &Quantity::name);
    expects(at != all.end(), "published parameters that the part has");
    table.quantity.push_back(static_cast<std::size_t>(at - all.begin()));
  }
  return table;
}

Placement nothing(const std::string& why) {
  Placement out;
  out.why_not = why;
  return out;
}

}  // namespace

Placement place_published(const Sweep& sweep, const Published& published,
                          const std::vector<BlockResult>& results) {
  expects(!published.readings.empty(), "a reading of the published results");
  const Table table = table_of(sweep, published, results);
  const std::vector<PublishedRow>& rows = table.published.rows;
  Placement out;
  for (std::size_t i = 0; i < table.published.readings.size(); ++i) {
    const Understood one = understood(table, i);
    if (!std::ranges::all_of(one.runs, [](const PrintedRun& run) {
          return run.covariance.allFinite() && run.covariance.diagonal().minCoeff() > 0.0;
        }))
      return nothing("\"" + table.published.readings[i].name +
                     "\" has no bound: the published runs cannot be placed");
    out.readings.push_back(placed(table, one));
    out.readings.back().gain =
        out.readings.back().log_likelihood - out.readings.front().log_likelihood;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (rows[row].unknown_axis) {
        out.unknown.push_back(level_of(table, one, row));
      } else if (i == 0) {
        out.among.push_back(among(table, one, row, results));
      }
    }
  }
  return out;
}

}  // namespace trueaxis::study
