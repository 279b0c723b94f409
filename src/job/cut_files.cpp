// SPDX-License-Identifier: Apache-2.0
#include "job/cut_files.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueaxis {
namespace {

/// The axis moves by what turns once per revolution, a diameter by twice that; at least the largest
/// deviation counts.
double diameter_mm(const Deviation& off) { return std::max(2.0 * off.once_mm, off.largest_mm); }

/// The name of the key that sets the length between two places of a table.
const char* length_key(ControlFormat format) {
  return format == ControlFormat::sinumerik_cec ? "band_mm" : "position_step_mm";
}

/// A finer table that adds `allowed_mm` at most; none: none that the format holds does.
Reasons finer_table(const Correction& correction, const ControlTable& table, double allowed_mm) {
  constexpr int halvings = 12;
  const bool one_step = table.format == ControlFormat::beckhoff_crosscomp2;  // of both axes
  double least = 1.0;
  for (int i = 0; i < halvings; ++i) {
    least *= 0.5;
    for (const auto& [of_length, of_angle] :
         {std::pair(least, 1.0), std::pair(1.0, least), std::pair(least, least)}) {
      if (one_step && of_length != of_angle) continue;
      ControlTable finer = table;
      finer.position_step_mm *= of_length;
      finer.c_step_rad *= of_angle;
      if (!objection_to(finer, correction.target, correction.tool).empty() ||
          diameter_mm(make_control_table(correction, finer).off) > allowed_mm)
        continue;
      Reasons keys;
      if (of_length < 1.0)
        keys.push_back({ReasonCode::set_step,
                        {},
                        {{"step", finer.position_step_mm, "mm"}},
                        {{"key", length_key(table.format)}}});
      if (of_angle < 1.0)
        keys.push_back({ReasonCode::set_c_step, {}, {{"step", finer.c_step_rad, "rad"}}});
      return keys;
    }
  }
  return {};
}

/// The control is stated to hold each row until the next.
bool holds_rows(const Correction& correction) {
  return correction.tool.interpolation == Interpolation::none;
}

/// More rows per revolution; none: 100000 are not enough.
Reasons more_rows(const PlannedJob& result, const ControlTable* table, double allowed_mm) {
  constexpr double most_rows = 1e5;
  const Correction& correction = *result.correction;
  const bool held = table == nullptr && holds_rows(correction);
  double rows = rows_that_would_do(correction, held ? Interpolation::none : Interpolation::linear,
                                   {allowed_mm, 0.5 * allowed_mm});
  if (table != nullptr && table->format == ControlFormat::halstreamer) {
    // A line that is held is off by a share of a row: in inverse proportion to their number.
    const auto at = static_cast<std::size_t>(table - result.job.outputs.data());
    constexpr double more = 1.01;
    rows = std::ceil(more * correction.tool.rows_per_revolution *
                     diameter_mm(result.control_files[at].off) / allowed_mm);
  }
  if (!(rows > 0.0) || rows > most_rows) return {};
  return {{ReasonCode::set_rows, {}, {{"rows", rows}}}};
}

/// More than allowed off between the rows, and with how many rows less.
std::optional<Reason> coarse_rows(const PlannedJob& result, Interpolation by) {
  const Correction& correction = *result.correction;
  const bool held = by == Interpolation::none;
  const double allowed_mm = allowed_between_rows_mm(result);
  const double off_mm = (held ? correction.held_rows : correction.between_rows).largest_mm;
  if (!(off_mm > allowed_mm)) return {};
  const int rows = rows_that_would_do(correction, by, {allowed_mm, allowed_mm});
  const Reason enough{ReasonCode::rows_that_would_do,
                      {},
                      {{"rows", static_cast<double>(rows)}, {"allowed", allowed_mm, "mm"}}};
  return Reason{
      held ? ReasonCode::rows_coarse_held : ReasonCode::rows_coarse,
      {},
      {{"rows", static_cast<double>(correction.tool.rows_per_revolution)}, {"off", off_mm, "mm"}},
      {},
      {},
      {rows > 0 ? enough : Reason{ReasonCode::rows_do_not_help}}};
}

}  // namespace

CutFile table_file(const Correction& correction, Interpolation by) {
  const bool held = by == Interpolation::none;
  CutFile table{"table.csv", 2.0 * correction.margin.following_once_mm,
                diameter_mm(held ? correction.held_rows : correction.between_rows)};
  // A control that sends X_command has the actuator's error, one that follows X_fts that between
  // the rows; one that holds what it sends has both.
  table.adds_mm =
      held ? table.actuator_mm + table.file_mm : std::max(table.actuator_mm, table.file_mm);
  return table;
}

std::vector<CutFile> cut_files(const PlannedJob& result) {
  const Correction& correction = *result.correction;
  const double actuator_mm = 2.0 * correction.margin.following_once_mm;
  std::vector<CutFile> files;
  for (std::size_t i = 0; i < result.control_files.size(); ++i) {
    const bool sent = result.job.outputs[i].format == ControlFormat::halstreamer;
    CutFile file{result.job.outputs[i].file, sent ? actuator_mm : 0.0,
                 diameter_mm(result.control_files[i].off)};
    file.adds_mm = file.actuator_mm + file.file_mm;
    files.push_back(std::move(file));
  }
  files.push_back(table_file(correction, correction.tool.interpolation));
  return files;
}

Reason what_would_do(const PlannedJob& result, const CutFile& file, double allowed_mm) {
  const auto output = std::ranges::find(result.job.outputs, file.name, &ControlTable::file);
  const ControlTable* table = output == result.job.outputs.end() ? nullptr : &*output;
  const bool sent = table != nullptr || holds_rows(*result.correction);
  const double left_mm = allowed_mm - (sent ? file.actuator_mm : 0.0);
  const bool rows = table == nullptr || table->format == ControlFormat::halstreamer ||
                    table->format == ControlFormat::servo_nc;
  const Reasons keys =
      rows ? more_rows(result, table, left_mm) : finer_table(*result.correction, *table, left_mm);
  return {keys.empty() ? ReasonCode::other_format : ReasonCode::file_would_do,
          {},
          {},
          {{"output", file.name}},
          keys};
}

double allowed_between_rows_mm(const PlannedJob& result) {
  return 0.1 *
         result.job.coaxiality_tolerance_mm.value_or(result.correction->margin.following_limit_mm);
}

Reasons coarse_rows(const PlannedJob& result) {
  const Interpolation stated = result.correction->tool.interpolation;
  Reasons coarse;
  for (const Interpolation by : {Interpolation::linear, Interpolation::none})
    if (stated == by || stated == Interpolation::not_stated)
      if (auto reason = coarse_rows(result, by)) coarse.push_back(std::move(*reason));
  return coarse;
}

}  // namespace trueaxis
