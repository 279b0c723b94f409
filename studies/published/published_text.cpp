// SPDX-License-Identifier: Apache-2.0
#include "studies/published/published_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

using namespace study;
using fmt::format;
using layout::padded;

std::string probability(double p) { return p > 0.995 ? "p > 0.995" : format("p = {:.2g}", p); }

std::string number_text(double value) {
  return std::isfinite(value) ? format("{:.3g}", value) : "-";
}

const Row& row_of(const Summary& summary, std::size_t cell, const std::string& quantity) {
  return *std::ranges::find_if(
      summary.rows, [&](const Row& row) { return row.cell == cell && row.quantity == quantity; });
}

std::string beside_text(const Published& published, const Summary& summary, const PlacedRow& placed,
                        const AmongRepeats& among) {
  const PublishedRow& printed = published.rows[placed.row];
  std::string text =
      '\n' + printed.name +
      format(": χ²({}) = {:.3g}, {}; {:.1f} % of the repeats are as far out\n", placed.error.size(),
             placed.chi_squared, probability(placed.p_value), 100.0 * among.share_as_far) +
      "  parameter   printed   error      in SD   below  | bias       SD        RMSE "
      "     5 %        50 %       95 %       bound     RMSE / bound\n";
  for (std::size_t i = 0; i < published.parameters.size(); ++i) {
    const Row& row = row_of(summary, among.cell, published.parameters[i]);
    text += "  " + padded(row.quantity, 12) + padded(printed.values[i].text, 10) +
            padded(number_text(placed.error[i]), 11) +
            padded(format("{:.2f}", placed.in_sd[i]), 8) +
            padded(format("{:.0f} %", 100.0 * among.share_below[i]), 7) + "| ";
    for (const double value : {row.bias, row.sd, row.rmse, row.q05, row.q50, row.q95, row.bound})
      text += padded(number_text(value), 11);
    text += format("{:.3f}", row.ratio) +
            (std::isfinite(row.ratio_95.low)
                 ? format(" ± {:.3f}", 0.5 * (row.ratio_95.high - row.ratio_95.low))
                 : "") +
            (row.at_bound.value_or(true) ? "" : " !") + (row.unit == "1" ? "" : "  " + row.unit) +
            '\n';
  }
  return text;
}

std::string factor_text(const PlacedReading& placed, bool fitted) {
  std::string text = format("noise × {:.3g}", placed.noise_factor);
  if (fitted)
    text += format(" (95 %: {} to {})", number_text(placed.noise_factor_95.low),
                   number_text(placed.noise_factor_95.high));
  return text;
}

std::string reading_text(const Published& published, const PlacedReading& placed,
                         std::size_t index) {
  const PublishedReading& reading = published.readings[index];
  std::string text = format("  {}  {}\n     log-likelihood {:.1f} ({:+.1f}), χ²({}) = {:.3g}, {}, ",
                            index + 1, reading.name, placed.log_likelihood, placed.gain,
                            placed.rows.size() * published.parameters.size(), placed.chi_squared,
                            probability(placed.p_value));
  text += factor_text(placed, reading.fit_noise) + "\n     each run: χ²";
  for (const PlacedRow& row : placed.rows)
    text += format("  {:.3g} ({})", row.chi_squared, probability(row.p_value));
  return text + '\n';
}

std::string unknown_text(const GridAxis& axis, const UnknownLevel& unknown) {
  const auto level = [&](double value) { return number_text(value / unknown.unit); };
  std::string text = format("  {}  ", unknown.reading + 1) + level(unknown.best) +
                     " (95 %: " + level(unknown.interval_95.low) + " to " +
                     level(unknown.interval_95.high) + "); log-likelihood lost:";
  for (std::size_t i = 0; i < unknown.points.size(); ++i)
    text += format("  {}: {:.1f}", axis.points[i].label, unknown.points[i].below_best);
  return text + '\n';
}

}  // namespace

std::string published_text(const Sweep& sweep, const Published& published, const Summary& summary,
                           const Placement& placement) {
  if (!placement.why_not.empty()) return published.source + '\n' + placement.why_not + '\n';
  std::string text = published.source +
                     "\nin SD: error over the bound's standard deviation; below: share of the "
                     "repeats, rounded as printed, with a smaller number\n";
  for (std::size_t i = 0; i < placement.among.size(); ++i)
    text += beside_text(published, summary, placement.readings.front().rows[i], placement.among[i]);
  text +=
      "\nReadings of the printed numbers (χ²: Mahalanobis distance squared, rounding included)\n";
  for (std::size_t i = 0; i < placement.readings.size(); ++i)
    text += reading_text(published, placement.readings[i], i);
  for (std::size_t i = 0; i < published.rows.size(); ++i) {
    if (!published.rows[i].unknown_axis) continue;
    const GridAxis& axis = sweep.axes[*published.rows[i].unknown_axis];
    text += '\n' + published.rows[i].name + ": the level under each reading\n";
    for (const UnknownLevel& unknown : placement.unknown) {
      if (unknown.row == i) text += unknown_text(axis, unknown);
    }
  }
  return text;
}

}  // namespace trueaxis
