// SPDX-License-Identifier: Apache-2.0
#include "measure/column_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double shown_angle_rad = two_pi / 6.0;
constexpr double rows_by_chance = 1e-3;
constexpr double often = 0.3;  // share of the rows
constexpr double many_steps = 10.0;
constexpr double largest_machine_mm = 20e3;
constexpr double thinnest_part_mm = 0.05;  // radius: it bends away from any probe

/// Readings in a row that show the same value.
struct Run {
  std::size_t begin = 0, end = 0;
  double turned_rad = 0.0;
  std::size_t size() const { return end - begin; }
};

/// Calls `use` for every run of a stream, single readings too.
template <class Use>
void for_each_run(const ProbeStream& stream, const Use& use) {
  Run run{0, 1, 0.0};
  for (std::size_t i = 1; i < stream.size(); ++i) {
    if (stream.reading_mm[i] == stream.reading_mm[i - 1]) {
      run.turned_rad += apart_rad(stream.c_rad[i], stream.c_rad[i - 1]);
    } else {
      use(run);
      run = {i, i, 0.0};
    }
    run.end = i + 1;
  }
  use(run);
}

/// Whether the value is met by several long runs: a sensor at its limit, once per revolution.
bool saturates(const ProbeStream& stream, const Run& longest) {
  std::size_t count = 0;
  for_each_run(stream, [&](const Run& one) {
    count += stream.reading_mm[one.begin] == stream.reading_mm[longest.begin] &&
             4 * one.size() >= longest.size();
  });
  return count > 1;
}

/// Whether a value is a tenth, ten times, … of what its neighbours say.
bool lost_its_point(double value, double expected, double step) {
  for (const double factor : {10.0, 0.1, 100.0, 0.01, 1000.0, 0.001, 1e4, 1e-4, 1e5, 1e-5})
    if (std::abs(value * factor - expected) <= near_steps * step * std::max(1.0, factor))
      return std::abs(value - expected) > 10.0 * near_steps * step;
  return false;
}

/// Data rows (from 1) whose value lies a power of ten off both neighbours, which agree.
std::vector<std::size_t> rows_off_by_tens(const std::vector<double>& column) {
  std::vector<std::size_t> rows;
  if (column.size() < shown_run) return rows;
  const double step = usual_step(column);
  if (!(step > 0.0)) return rows;
  for (std::size_t i = 1; i + 1 < column.size(); ++i) {
    const double expected = 0.5 * (column[i - 1] + column[i + 1]);
    if (std::abs(column[i] - expected) <= 10.0 * near_steps * step ||
        std::abs(column[i + 1] - column[i - 1]) > near_steps * step)
      continue;
    if (lost_its_point(column[i], expected, step)) rows.push_back(i + 1);
  }
  return rows;
}

/// The same numbers in a row and the row before.
bool repeats_row(const ProbeStream& stream, std::size_t i) {
  return stream.reading_mm[i] == stream.reading_mm[i - 1] &&
         stream.c_rad[i] == stream.c_rad[i - 1] &&
         (!stream.has_position() || stream.position_mm[i] == stream.position_mm[i - 1]);
}

}  // namespace

double usual_step(const std::vector<double>& column) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < column.size(); i += 1 + column.size() / 2000)
    steps.push_back(std::abs(column[i] - column[i - 1]));
  return steps.empty() ? 0.0 : median(std::move(steps));
}

std::string stuck_probe(const ProbeStream& stream) {
  if (stream.size() < shown_run) return "";
  Run longest;
  std::size_t runs = 0;
  for_each_run(stream, [&](const Run& one) {
    ++runs;
    if (one.turned_rad > longest.turned_rad) longest = one;
  });
  if (longest.size() < shown_run || longest.turned_rad < shown_angle_rad) return "";
  const double others = static_cast<double>(stream.size() - longest.size());
  const double repeated = others - static_cast<double>(runs - 1);
  const double share = std::max(repeated, 1.0) / std::max(others, 2.0);
  const double expected =
      static_cast<double>(stream.size()) * std::pow(share, static_cast<double>(longest.size() - 1));
  if (expected > rows_by_chance || saturates(stream, longest)) return "";
  return fmt::format(
      "{} shows {:.9g} mm in {} readings without a break (data rows {} to {}) while C turns by "
      "{:.3g} revolutions: the probe was stuck, off the part or not connected. Remove these rows, "
      "or probe again",
      stream.kind == StreamKind::face ? "Z_M" : "X_M", stream.reading_mm[longest.begin],
      longest.size(), longest.begin + 1, longest.end, longest.turned_rad / two_pi);
}

LimitsMet limits_met(const ProbeStream& stream) {
  LimitsMet met;
  const auto [low, high] = range_of(stream.reading_mm);
  met.low_mm = low, met.high_mm = high;
  met.at_high = static_cast<std::size_t>(std::ranges::count(stream.reading_mm, high));
  met.at_low = static_cast<std::size_t>(std::ranges::count(stream.reading_mm, low));
  const std::size_t distinct = distinct_values(stream.reading_mm).count;
  const double repeats = static_cast<double>(stream.size()) / static_cast<double>(distinct);
  met.saturates = static_cast<double>(std::max(met.at_low, met.at_high)) >
                  std::max(few_at_a_limit, more_at_a_limit * repeats);
  return met;
}

std::string repeated_rows(const ProbeStream& stream) {
  std::size_t repeated = 0, held = 0;
  std::vector<double> changes;
  for (std::size_t i = 1; i < stream.size(); ++i) {
    const double change = std::abs(stream.reading_mm[i] - stream.reading_mm[i - 1]);
    repeated += repeats_row(stream, i);
    held += change == 0.0 && stream.c_rad[i] != stream.c_rad[i - 1];
    if (change > 0.0 && changes.size() < 2000) changes.push_back(change);
  }
  if (static_cast<double>(repeated) > often * static_cast<double>(stream.size()))
    return fmt::format(
        "{} of {} rows repeat the row before: as separate readings they would make every U too "
        "small. Remove the copies",
        repeated, stream.size());
  if (static_cast<double>(held) <= often * static_cast<double>(stream.size()) ||
      changes.size() < shown_run)
    return "";
  // A coarse sensor moves by its step; one that is read too often by far more than its least.
  const double usual = median(changes), least = *std::ranges::min_element(changes);
  if (usual < many_steps * least) return "";
  return fmt::format(
      "X_M stays the same in {:.0f} % of the rows while C turns, and then changes by {} µm: "
      "the probe is read more slowly than C. Remove the rows in which it was not read anew",
      100.0 * static_cast<double>(held) / static_cast<double>(stream.size()),
      significant(usual / mm_per_um, 2));
}

std::string counts_rows(const ProbeStream& stream) {
  if (stream.size() < 4 * shown_run) return "";
  const double step = stream.reading_mm[1] - stream.reading_mm[0];
  const double rounding = 1e-9 * std::max(std::abs(stream.reading_mm.back()), 1.0);
  if (std::abs(step) <= rounding) return "";
  for (std::size_t i = 1; i < stream.size(); ++i)
    if (std::abs(stream.reading_mm[i] - stream.reading_mm[i - 1] - step) > rounding) return "";
  return "X_M grows by the same amount from row to row: it counts the rows. Name the probe's "
         "column";
}

std::string no_such_size(const ProbeStream& stream) {
  const bool face = stream.kind == StreamKind::face;
  const auto largest = [](const std::vector<double>& column) {
    if (column.empty()) return 0.0;
    const auto [low, high] = range_of(column);
    return std::max(std::abs(low), std::abs(high));
  };
  const struct {
    const char* name;
    double mm;
  } sizes[] = {{face ? "Z_M" : "X_M", largest(stream.reading_mm)},
               {face ? "X" : "Z", largest(stream.position_mm)}};
  for (const auto& [name, mm] : sizes)
    if (mm > largest_machine_mm)
      return fmt::format(
          "{} reaches {:.4g} m, and no lathe is larger than {:.0f} m: check its unit and its "
          "decimal point",
          name, mm / mm_per_m, largest_machine_mm / mm_per_m);
  if (const double mm = sizes[0].mm;
      !face && stream.indication == Indication::absolute && mm > 0.0 && mm < thinnest_part_mm)
    return fmt::format(
        "X_M stays below {:.3g} µm, and no part that a probe touches is that thin: check its unit. "
        "For a gauge write '# reading: relative'",
        1e3 * thinnest_part_mm);
  return "";
}

std::string lost_decimal_point(const ProbeStream& stream) {
  const bool face = stream.kind == StreamKind::face;
  const struct {
    const char* name;
    const std::vector<double>& values;
  } columns[] = {{face ? "Z_M" : "X_M", stream.reading_mm},
                 {"C", stream.c_rad},
                 {face ? "X" : "Z", stream.position_mm}};
  for (const auto& [name, values] : columns) {
    const std::vector<std::size_t> rows = rows_off_by_tens(values);
    // A few readings of that kind are outliers, which a robust loss withstands.
    if (rows.size() < (&values == &stream.reading_mm ? 4U : 2U)) continue;
    return fmt::format(
        "{} values of {} are a power of ten off their neighbours (the first in data row {}): a "
        "decimal point was lost. Correct them, or remove these rows",
        rows.size(), name, rows.front());
  }
  return "";
}

std::string column_objection(const ProbeStream& stream) {
  if (!stream.x_convention) return "";  // who fills a stream in a program may model anything
  for (const auto& check : {stuck_probe, no_such_size, repeated_rows, counts_rows,
                            lost_decimal_point, unit_changes, column_out_of_order}) {
    stop_if_asked();
    if (std::string why = check(stream); !why.empty()) return why;
  }
  return "";
}

}  // namespace trueaxis
