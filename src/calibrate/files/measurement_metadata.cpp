// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "base/edit_distance.hpp"
#include "base/number.hpp"
#include "calibrate/files/measurement_header.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"

namespace trueaxis {
namespace {

constexpr std::array keys{"kind", "noise", "axis", "gear_ratio"};
constexpr std::array kinds{MeasurementKind::ball, MeasurementKind::bar, MeasurementKind::array,
                           MeasurementKind::axis};

std::string take_kind(std::string_view value, MeasurementMetadata& metadata) {
  for (const MeasurementKind kind : kinds)
    if (value == to_string(kind)) metadata.kind = kind;
  return metadata.kind ? "" : csv_quoted(value) + " is not a kind: write ball, bar, array or axis";
}

std::string take_noise(std::string_view value, MeasurementMetadata& metadata) {
  for (const UnitKind quantity : {UnitKind::length, UnitKind::angle}) {
    const auto noise = quantity_in(value, quantity);
    if (!noise) continue;
    if (!(*noise > 0.0)) return "noise must be more than 0: the standard deviation of a read-out";
    metadata.noise = noise;
    metadata.noise_is_angle = quantity == UnitKind::angle;
    return "";
  }
  return csv_quoted(value) + " is not a noise: write a number and its unit, such as 1 um";
}

std::string take_axis(std::string_view value, MeasurementMetadata& metadata) {
  const std::size_t at = std::string_view("XYZABC").find(value);
  if (value.size() != 1 || at == std::string_view::npos)
    return csv_quoted(value) + " is not an axis: write one of X Y Z A B C";
  metadata.axis = static_cast<AxisName>(at);
  return "";
}

std::string take_gear_ratio(std::string_view value, MeasurementMetadata& metadata) {
  const auto ratio = whole_number<int>(value);
  constexpr int most = 10000;
  if (!ratio || *ratio < 2 || *ratio > most)
    return csv_quoted(value) +
           " is not a gear ratio: write how often the gear turns per revolution of the axis, 2 to "
           "10000";
  metadata.gear_ratio = ratio;
  return "";
}

/// The known key that `word` was meant to be, or nothing.
const char* meant(std::string_view word) {
  for (const char* key : keys)
    if (word != key && edit_distance(word, key) == 1) return key;
  return nullptr;
}

}  // namespace

void take_measurement_comment(std::string_view line, std::size_t number,
                              MeasurementMetadata& metadata, CsvDiagnostics& diagnostics) {
  const std::size_t hash = line.find('#');
  std::string_view text = trimmed(line.substr(hash + 1));
  if (text.starts_with('#')) return;
  const std::size_t colon = text.find_first_of(":=");
  if (colon == std::string_view::npos) return;
  const std::string key(trimmed(text.substr(0, colon)));
  const std::string_view value = trimmed(text.substr(colon + 1));
  const std::size_t column =
      csv_character(line, static_cast<std::size_t>(text.data() - line.data()));
  if (const char* const known = meant(key)) {
    diagnostics.add(number, column, csv_quoted(key) + " is not a key: did you mean " + known + "?");
    return;
  }
  if (std::ranges::find(keys, key) == keys.end()) return;
  std::string wrong;
  if (text[colon] == '=')
    wrong = "write `# " + key + ": …` with a colon";
  else if (!metadata.lines.try_emplace(key, number).second)
    wrong = key + " is given twice: keep one";
  else
    wrong = key == "kind"    ? take_kind(value, metadata)
            : key == "noise" ? take_noise(value, metadata)
            : key == "axis"  ? take_axis(value, metadata)
                             : take_gear_ratio(value, metadata);
  if (!wrong.empty()) diagnostics.add(number, column, std::move(wrong));
}

}  // namespace trueaxis
