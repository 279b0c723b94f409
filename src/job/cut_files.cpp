// SPDX-License-Identifier: Apache-2.0
#include "job/cut_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// The axis moves by what turns once a revolution, a diameter by twice that; and no less than the
/// largest deviation is ever counted.
double diameter_mm(const Deviation& off) { return std::max(2.0 * off.once_mm, off.largest_mm); }

/// The name of the key that sets the length between two places of a table.
const char* length_key(ControlFormat format) {
  return format == ControlFormat::sinumerik_cec ? "band_mm" : "position_step_mm";
}

/// A finer table that adds `allowed_mm` at most; empty: none that the format holds does.
std::string finer_table(const Correction& correction, const ControlTable& table,
                        double allowed_mm) {
  constexpr int halvings = 12;
  const bool one_step = table.format == ControlFormat::beckhoff_crosscomp2;  // of both axes
  const char* length = length_key(table.format);
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
      std::string keys;
      if (of_length < 1.0) keys = fmt::format("{} = {:.6g}", length, finer.position_step_mm);
      if (of_angle < 1.0)
        keys += fmt::format("{}c_step_deg = {:.6g}", keys.empty() ? "" : " and ",
                            finer.c_step_rad / rad_per_deg);
      return keys;
    }
  }
  return "";
}

/// More rows a revolution; empty: 100000 are not enough.
std::string more_rows(const JobResult& result, const ControlTable* table, double allowed_mm) {
  constexpr double most_rows = 1e5;
  const Correction& correction = *result.correction;
  double rows = rows_that_would_do(correction, {allowed_mm, 0.5 * allowed_mm});
  if (table != nullptr && table->format == ControlFormat::halstreamer) {
    // A line that is held is off by a share of a row: in inverse proportion to their number.
    const auto at = static_cast<std::size_t>(table - result.job.outputs.data());
    constexpr double more = 1.01;
    rows = std::ceil(more * correction.tool.rows_per_revolution *
                     diameter_mm(result.control_files[at].off) / allowed_mm);
  }
  if (!(rows > 0.0) || rows > most_rows) return "";
  return fmt::format("rows_per_revolution = {:.0f} in [cut]", rows);
}

}  // namespace

std::vector<CutFile> cut_files(const JobResult& result) {
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
  // Who sends X_command has the actuator's error, who follows X_fts that between the rows.
  CutFile table{"table.csv", actuator_mm, diameter_mm(correction.between_rows)};
  table.adds_mm = std::max(table.actuator_mm, table.file_mm);
  files.push_back(std::move(table));
  return files;
}

std::string what_would_do(const JobResult& result, const CutFile& file, double allowed_mm) {
  const auto output = std::ranges::find(result.job.outputs, file.name, &ControlTable::file);
  const ControlTable* table = output == result.job.outputs.end() ? nullptr : &*output;
  const double left_mm = allowed_mm - (table == nullptr ? 0.0 : file.actuator_mm);
  const bool rows = table == nullptr || table->format == ControlFormat::halstreamer ||
                    table->format == ControlFormat::servo_nc;
  const std::string key =
      rows ? more_rows(result, table, left_mm) : finer_table(*result.correction, *table, left_mm);
  if (!key.empty()) return file.name + " would do with " + key;
  return fmt::format(
      "{} does not keep the tolerance with any step that the format allows: take another format",
      file.name);
}

double allowed_between_rows_mm(const JobResult& result) {
  return 0.1 *
         result.job.coaxiality_tolerance_mm.value_or(result.correction->margin.following_limit_mm);
}

std::string coarse_rows(const JobResult& result) {
  const Correction& correction = *result.correction;
  const double allowed_mm = allowed_between_rows_mm(result);
  const double off_mm = correction.between_rows.largest_mm;
  if (!(off_mm > allowed_mm)) return "";
  const int rows = rows_that_would_do(correction, {allowed_mm, allowed_mm});
  const std::string enough =
      rows > 0 ? fmt::format("with rows_per_revolution = {} it is at most {:.3g} µm", rows,
                             allowed_mm / mm_per_um)
               : "more rows do not help";
  return fmt::format(
      "{} rows per revolution: straight lines between them are off by up to {:.3g} "
      "µm; {}",
      correction.tool.rows_per_revolution, off_mm / mm_per_um, enough);
}

}  // namespace trueaxis
