// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "measure/column_checks.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// A factor between two units, and what it looks like.
struct UnitFactor {
  double factor;
  const char* what;
};
constexpr UnitFactor of_lengths[] = {{25.4, "inch and mm"},        {10.0, "a decimal point"},
                                     {100.0, "a decimal point"},   {1e3, "µm, mm or m"},
                                     {2.0, "radius and diameter"}, {-1.0, "its sign"}};
constexpr UnitFactor of_angles[] = {{1.0 / rad_per_deg, "degrees and radians"},
                                    {360.0, "degrees and turns"},
                                    {two_pi, "radians and turns"},
                                    {10.0, "a decimal point"}};

/// Where a column changes its unit, and how.
struct UnitChange {
  std::size_t row = 0;  ///< data row, from 1
  const char* what = "";
};

std::string other_unit_text(const char* name, const UnitChange& at) {
  return fmt::format(
      "{} goes on in another unit from data row {} ({}): correct it, or give each part of the "
      "stream a file of its own",
      name, at.row, at.what);
}

/// Step of a column that runs on evenly over `shown_run` rows from `begin`; 0: it does not.
double even_step(const std::vector<double>& column, std::size_t begin) {
  constexpr double even = 0.5;  // of the step
  const double step = (column[begin + shown_run - 1] - column[begin]) / (shown_run - 1);
  for (std::size_t i = begin + 1; i < begin + shown_run; ++i)
    if (std::abs(column[i] - column[i - 1] - step) > even * std::abs(step)) return 0.0;
  return step;
}

/// Of C or a position that runs on: value and step are a unit times those before, to a step.
std::optional<UnitChange> way_changes_unit(const std::vector<double>& column, bool angle) {
  constexpr double alike = 0.2;  // of the step: a feed is even to a few per cent
  const std::span<const UnitFactor> units =
      angle ? std::span<const UnitFactor>(of_angles) : std::span<const UnitFactor>(of_lengths);
  for (std::size_t i = shown_run; i + shown_run <= column.size(); ++i) {
    const double before = even_step(column, i - shown_run);
    if (before == 0.0 || !(std::abs(column[i] - column[i - 1]) > near_steps * std::abs(before)))
      continue;
    const double after = even_step(column, i);
    for (const auto& [unit, what] : units) {
      for (const double factor : {unit, 1.0 / unit}) {
        const double expected = factor * (column[i - 1] + before), step = factor * before;
        // About zero a pass that turns back looks as one of the other sign.
        if (unit < 0.0 && std::abs(expected) < shown_run * std::abs(step)) continue;
        if (std::abs(after - step) <= alike * std::abs(step) &&
            std::abs(column[i] - expected) <= near_steps * std::abs(step))
          return UnitChange{i + 1, what};
      }
    }
  }
  return {};
}

/// How much a turn of readings is apart from the turn before.
struct TurnStep {
  double mean_mm = 0.0, scatter_mm = 0.0;
};

TurnStep step_of(const std::vector<double>& apart_mm) {
  const auto count = static_cast<double>(apart_mm.size());
  TurnStep step;
  for (const double d : apart_mm) step.mean_mm += d / count;
  double squares = 0.0;
  for (const double d : apart_mm) squares += (d - step.mean_mm) * (d - step.mean_mm);
  step.scatter_mm = std::sqrt(squares / count);
  return step;
}

/// For readings: a turn is a unit times the turn before, but for the step that the taper made
/// before and the scatter about it. A seat of twice the radius has no twice the eccentricity.
std::optional<UnitChange> reading_changes_unit(const ProbeStream& stream) {
  const std::vector<double>& x = stream.reading_mm;
  if (stream.kind == StreamKind::face || stream.indication == Indication::relative) return {};
  const double step_rad = usual_step(stream.c_rad);
  if (!(step_rad > 0.0)) return {};
  const auto turn = static_cast<std::size_t>(std::lround(two_pi / step_rad));
  if (turn < shown_run) return {};
  std::vector<bool> begins(x.size(), false);  // of a pass: the rear side has the other sign
  std::vector<std::size_t> pass_of(x.size(), 0);
  std::size_t passes = 0;
  for (const Pass& pass : find_passes(stream)) {
    begins[pass.begin] = true;
    for (std::size_t i = pass.begin; i < pass.end; ++i) pass_of[i] = passes;
    ++passes;
  }
  const auto apart_mm = [&](std::size_t begin, double factor, bool within_pass) {
    std::vector<double> apart;  // of a turn from the turn before
    for (std::size_t i = begin; i < begin + turn; ++i)
      if (!within_pass || pass_of[i] == pass_of[i - turn])
        apart.push_back(x[i] / factor - x[i - turn]);
    return apart;
  };
  // Within a pass: one section is not as the next. Sections of one turn have only those.
  const auto usual_step_mm = [&](std::size_t begin) {
    const std::vector<double> within = apart_mm(begin, 1.0, true);
    return step_of(2 * within.size() < turn ? apart_mm(begin, 1.0, false) : within);
  };
  for (std::size_t i = 2 * turn; i + turn <= x.size(); ++i) {
    for (const auto& [unit, what] : of_lengths) {
      if (unit < 0.0 && begins[i]) continue;
      for (const double factor : {unit, 1.0 / unit}) {
        if (std::abs(x[i] - factor * x[i - 1]) > 0.05 * std::abs(factor * x[i - 1])) continue;
        const TurnStep usual = usual_step_mm(i - turn);
        const auto goes_on = [&](double by) {
          const TurnStep step = step_of(apart_mm(i, by, false));
          const double beyond_mm = std::max(0.0, std::abs(step.mean_mm) - std::abs(usual.mean_mm));
          return std::hypot(step.scatter_mm, beyond_mm) <= near_steps * usual.scatter_mm;
        };
        if (goes_on(factor) && !goes_on(1.0)) return UnitChange{i + 1, what};
      }
    }
  }
  return {};
}

}  // namespace

std::string unit_changes(const ProbeStream& stream) {
  const bool face = stream.kind == StreamKind::face;
  for (const auto& [column, name] :
       {std::pair{&stream.c_rad, "C"}, std::pair{&stream.position_mm, face ? "X" : "Z"}})
    if (const auto at = way_changes_unit(*column, column == &stream.c_rad))
      return other_unit_text(name, *at);
  const auto at = reading_changes_unit(stream);
  return at ? other_unit_text(face ? "Z_M" : "X_M", *at) : "";
}

}  // namespace trueaxis
