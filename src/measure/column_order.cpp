// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "math/statistics.hpp"
#include "measure/column_checks.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t least_rows = 100;  // the ratio of a random order is then 2 ± 0.2
constexpr double as_random = 1.0;        // of the ratio: five standard deviations below 2
constexpr double as_a_machine = 0.1;     // of the ratio: 11 readings a stroke and more
constexpr double chance_sds = 4.0;
constexpr double even_turning = 0.5;        // of the mean of exp(iΔC)
constexpr double least_turns = 2.0;         // rows sorted by angle span one
constexpr double as_sorted_numbers = 0.75;  // of the unevenness of steps: they have 1, noise 0.55
constexpr double fine_step = 0.1;           // of the mean step: the column is not rounded to it

/// Mean square of the steps over the variance (von Neumann 1941): 2 in a random order.
double step_ratio(const std::vector<double>& column) {
  const auto n = static_cast<double>(column.size());
  double mean = 0.0, variance = 0.0, steps = 0.0;
  for (const double v : column) mean += v / n;
  for (const double v : column) variance += (v - mean) * (v - mean) / n;
  for (std::size_t i = 1; i < column.size(); ++i)
    steps += (column[i] - column[i - 1]) * (column[i] - column[i - 1]) / (n - 1.0);
  return variance > 0.0 ? steps / variance : 0.0;
}

/// Whether most values are met once, as by a probe that reads while the machine moves.
bool moves_on(const std::vector<double>& column) {
  std::vector<double> values = column;
  std::ranges::sort(values);
  const auto distinct = std::ranges::unique(values).begin() - values.begin();
  return 2 * static_cast<std::size_t>(distinct) > column.size();
}

/// How evenly C turns: 1, always by the same step, or by the same as the step before, of whichever
/// sense; 1/√N, at random.
double evenness_of_turning(const std::vector<double>& c_rad) {
  std::complex<double> same = 0.0, as_before = 0.0, before = 0.0;
  for (std::size_t i = 1; i < c_rad.size(); ++i) {
    const std::complex<double> step = std::polar(1.0, c_rad[i] - c_rad[i - 1]);
    same += step, as_before += step * std::conj(before);
    before = step;
  }
  return std::max(std::abs(same), std::abs(as_before)) / static_cast<double>(c_rad.size() - 1);
}

/// Whether the steps of a column that never falls, or never rises, differ as those of sorted
/// numbers do: neighbouring steps by as much as their mean. Noise that leaves the column monotone
/// makes at most half of that.
bool was_sorted(const std::vector<double>& column) {
  const double sense = column.back() >= column.front() ? 1.0 : -1.0;
  const double length = std::abs(column.back() - column.front());
  const double mean = length / static_cast<double>(column.size() - 1);
  double least = length, unevenness = 0.0, before = 0.0;
  for (std::size_t i = 1; i < column.size(); ++i) {
    const double step = sense * (column[i] - column[i - 1]);
    if (step < 0.0) return false;
    if (step > 0.0) least = std::min(least, step);
    if (i > 1) unevenness += std::abs(step - before);
    before = step;
  }
  return least < fine_step * mean && unevenness > as_sorted_numbers * length;
}

std::string jumps(const char* column, const char* other) {
  return fmt::format(
      "{} jumps at random from row to row while {} goes on evenly: the column was shuffled or "
      "sorted alone. Export the rows as they were recorded",
      column, other);
}

}  // namespace

std::string column_out_of_order(const ProbeStream& stream) {
  if (stream.size() < least_rows) return "";
  const bool face = stream.kind == StreamKind::face;
  const char* position = face ? "X" : "Z";
  const double chance = chance_sds / std::sqrt(static_cast<double>(stream.size()));
  const double evenness = evenness_of_turning(stream.c_rad);
  const double z = stream.has_position() ? step_ratio(stream.position_mm) : 0.0;
  const bool z_moves = stream.has_position() && moves_on(stream.position_mm);
  if (z_moves && z < as_a_machine && evenness < chance && moves_on(stream.c_rad))
    return jumps("C", position);
  if (evenness < even_turning || range_of(stream.c_rad).length() < least_turns * two_pi) return "";
  if (z_moves && z > as_random) return jumps(position, "C");
  if (was_sorted(stream.reading_mm))
    return fmt::format(
        "{} never turns back, and its steps are as uneven as those of sorted numbers, while C "
        "turns "
        "by {:.3g} revolutions: the column was sorted alone. Export the rows as they were recorded",
        face ? "Z_M" : "X_M", range_of(stream.c_rad).length() / two_pi);
  return "";
}

}  // namespace trueaxis
