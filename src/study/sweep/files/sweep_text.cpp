// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/counted.hpp"
#include "format/text_layout.hpp"
#include "study/sweep/files/sweep_results.hpp"

namespace trueaxis {
namespace {

using namespace study;
using fmt::format;

constexpr std::size_t cells_in_full = 12;

std::string cell_title(const Sweep& sweep, std::size_t cell) {
  const Cell at = cell_at(sweep, cell);
  const std::vector<std::string> labels = labels_of(sweep, at);
  std::string text;
  for (std::size_t a = 0; a < labels.size(); ++a)
    text += format("{} = {}, ", sweep.axes[a].name, labels[a]);
  return text + to_string(at.method);
}

std::string cell_note(const Sweep& sweep, const CellSummary& cell) {
  std::string text = format(": {} readings", cell.readings);
  if (std::isfinite(cell.found.value))
    text += format(", found in {:.1f} %", 100.0 * cell.found.value);
  if (std::isfinite(cell.named.value))
    text += format(", named in {:.1f} %", 100.0 * cell.named.value);
  if (cell.failures > 0)
    text += format(", {} of {} failed ({})", cell.failures, sweep.repeats, cell.why);
  if (cell.bound.missing != Bound::Missing::nothing)
    return text + ", no bound: " + to_string(cell.bound.missing) + '\n';
  if (cell.bound.kind == Bound::Kind::gauss_markov) text += ", bound of linear estimates";
  return text + '\n';
}

/// A ratio with the half width that its repeats leave it; "!" where it is not the bound's.
std::string ratio_text(const Row& row) {
  if (!std::isfinite(row.ratio)) return "-";
  if (!std::isfinite(row.ratio_95.low)) return format("{:.2f}", row.ratio);
  return format("{:.3f} ± {:.3f}", row.ratio, 0.5 * (row.ratio_95.high - row.ratio_95.low)) +
         (row.at_bound.value_or(true) ? "" : " !");
}

std::string value_text(double value) {
  return std::isfinite(value) ? format("{:.3g}", value) : "-";
}

std::string row_text(const Row& row) {
  std::string text = "  " + layout::padded(row.quantity, 14);
  text += layout::padded(std::isfinite(row.truth) ? format("{:.6g}", row.truth) : "-", 12);
  for (const double value : {row.bias, row.sd, row.rmse, row.bound})
    text += layout::padded(value_text(value), 11);
  text += layout::padded(ratio_text(row), 18);
  text += layout::padded(
      std::isfinite(row.coverage.value) ? format("{:.1f} %", 100.0 * row.coverage.value) : "-", 9);
  return text + (row.unit == "1" ? "" : row.unit) + '\n';
}

std::string full_text(const Sweep& sweep, const Summary& summary) {
  std::string text;
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
    text += '\n' + cell_title(sweep, cell) + cell_note(sweep, summary.cells[cell]);
    text +=
        "  parameter     true        bias       SD         RMSE       bound      "
        "RMSE / bound      U covers\n";
    for (const Row& row : summary.rows_of(cell)) text += row_text(row);
  }
  return text;
}

std::string short_text(const Sweep& sweep, const Summary& summary) {
  std::string text = "\nRMSE / bound, smallest and largest over the parameters; U covers\n";
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
    double low = INFINITY, high = -INFINITY, least = INFINITY;
    for (const Row& row : summary.rows_of(cell)) {
      if (std::isfinite(row.ratio))
        low = std::min(low, row.ratio), high = std::max(high, row.ratio);
      if (std::isfinite(row.coverage.value)) least = std::min(least, row.coverage.value);
    }
    text += "  " + cell_title(sweep, cell) + ": ";
    const CellSummary& of = summary.cells[cell];
    const std::string why = to_string(of.bound.missing);
    text += std::isfinite(low) ? format("{:.3f} to {:.3f}", low, high)
            : why.empty()      ? "no result"
                               : "no bound (" + why + ")";
    if (std::isfinite(least)) text += format(", at least {:.1f} %", 100.0 * least);
    if (of.failures > 0) text += format(", {} failed", of.failures);
    if (std::isfinite(of.found.value)) text += format(", found {:.1f} %", 100.0 * of.found.value);
    if (std::isfinite(of.named.value)) text += format(", named {:.1f} %", 100.0 * of.named.value);
    text += '\n';
  }
  return text;
}

/// "2 of 6 cells have no result: …", or nothing.
std::string without_result_text(const Sweep& sweep, const Summary& summary) {
  constexpr std::size_t most_named = 4;
  std::vector<std::string> which;
  std::string why;
  for (std::size_t cell = 0; cell < summary.cells.size(); ++cell) {
    if (summary.cells[cell].failures < sweep.repeats) continue;
    if (which.empty()) why = summary.cells[cell].why;
    which.push_back(cell_title(sweep, cell));
  }
  if (which.empty()) return "";
  const std::size_t count = which.size();
  if (count > most_named) {
    which.resize(most_named);
    which.push_back(format("and {} more", count - most_named));
  }
  return format("\n{} of {} cells have no result: {} ({})\n", count, summary.cells.size(),
                fmt::join(which, "; "), why);
}

}  // namespace

std::string sweep_text(const Sweep& sweep, const Summary& summary) {
  std::string text = (sweep.name.empty() ? "" : sweep.name + ": ") +
                     format("{}, {} repeats each, seed {}\n", counted(summary.cells.size(), "cell"),
                            sweep.repeats, sweep.seed);
  text += summary.cells.size() <= cells_in_full ? full_text(sweep, summary)
                                                : short_text(sweep, summary);
  text += without_result_text(sweep, summary);
  const auto tested =
      std::ranges::count_if(summary.rows, [](const Row& row) { return row.at_bound.has_value(); });
  const auto off =
      std::ranges::count_if(summary.rows, [](const Row& row) { return row.at_bound == false; });
  if (tested > 0) {
    text += format("\n{} of {} ratios are at the bound (! are not; false alarm rate {:g} %)\n",
                   tested - off, tested, 100.0 * bonferroni_level);
  }
  return text;
}

}  // namespace trueaxis
