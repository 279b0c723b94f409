// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_metadata.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "measure/files/stream_csv_comment.hpp"
#include "measure/files/stream_csv_number.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "measure/files/stream_csv_setup.hpp"
#include "measure/files/stream_csv_unit.hpp"

namespace trueaxis {
namespace {

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool is_known(std::string_view key) {
  constexpr std::string_view keys[] = {"x_convention", "reading",     "nominal_radius",
                                       "sensor_noise", "spindle_rpm", "ball_radius",
                                       "sensor_angles"};
  return csv_is_setup_key(key) ||
         std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

/// A finite number and what follows it.
struct NumberWithUnit {
  double value = 0.0;
  std::string_view unit;
};

std::optional<NumberWithUnit> parse_number(std::string_view text) {
  NumberWithUnit out;
  std::errc error{};
  const char* end = text.data() + text.size();
  const char* stop = csv_number(text.data(), end, out.value, error);
  if (stop == text.data() || error != std::errc{} || !std::isfinite(out.value)) return {};
  out.unit = csv_trimmed({stop, static_cast<std::size_t>(end - stop)});
  return out;
}

/// "14.5 mm" in mm; a number alone is no length.
std::optional<double> parse_length_mm(std::string_view text) {
  const auto number = parse_number(text);
  if (!number) return {};
  const auto unit = csv_find_unit(CsvQuantity::length, number->unit);
  if (!unit) return {};
  return number->value * unit->factor;
}

bool lacks_unit(std::string_view text) {
  const auto number = parse_number(text);
  return number && number->unit.empty();
}

bool is_length(std::string_view key) {
  return key == "nominal_radius" || key == "sensor_noise" || key == "ball_radius";
}

std::string not_understood(const std::string& key, std::string_view value, const char* wanted) {
  if (is_length(key) && lacks_unit(value))
    return key + ": " + csv_quoted(value) + " has no unit: write " + wanted;
  return key + ": " + csv_quoted(value) + " is not understood: write " + wanted;
}

}  // namespace

bool csv_is_key(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80U && (std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-');
  });
}

void CsvMetadataReader::comment(std::string_view line, std::size_t line_number) {
  const std::size_t hash = line.find('#');
  const std::size_t colon = std::min(line.find(':', hash + 1), line.size());
  const std::string_view written = csv_trimmed(line.substr(hash + 1, colon - hash - 1));
  std::string key = lower_case(written);
  const bool is_known_key = colon < line.size() && is_known(key);
  if (!is_known_key && refuse_trouble(line, hash, line_number)) return;
  if (colon == line.size() || !csv_is_key(written)) return;
  const std::string_view value = csv_trimmed(line.substr(colon + 1));
  if (!is_known_key) key = written;
  const auto [entry, first] = metadata.emplace(key, csv_utf8(value));
  if (is_known_key) {
    const std::size_t byte =
        value.empty() ? colon : static_cast<std::size_t>(value.data() - line.data());
    const std::size_t column = csv_character(line, byte);
    if (first) {
      known_lines_[key] = line_number;
      known_key(key, value, line_number, column);
    } else if (entry->second != csv_utf8(value)) {
      diagnostics_.add(line_number, column,
                       key + " is " + csv_quoted(value) + " here and " + csv_quoted(entry->second) +
                           " in line " + std::to_string(known_lines_[key]) + ": keep one");
    }
  } else if (!first) {
    entry->second += "; " + csv_utf8(value);
  }
}

void CsvMetadataReader::comment_behind(std::string_view line, std::size_t hash,
                                       std::size_t line_number) {
  const std::string_view text = line.substr(hash + 1);
  const std::size_t colon = text.find(':');
  const std::string_view written = csv_trimmed(text.substr(0, colon));
  if (colon == std::string_view::npos || !is_known(lower_case(written))) {
    refuse_trouble(line, hash, line_number);
  } else {
    diagnostics_.add(line_number, csv_character(line, hash),
                     csv_quoted(written) +
                         " stands behind a row, where it is not read: give it a "
                         "line of its own");
  }
}

bool CsvMetadataReader::refuse_trouble(std::string_view line, std::size_t hash,
                                       std::size_t line_number) {
  std::string trouble = csv_comment_trouble(line.substr(hash + 1));
  if (trouble.empty()) return false;
  const std::size_t text = line.find_first_not_of(" \t", hash + 1);
  diagnostics_.add(line_number, csv_character(line, text), std::move(trouble));
  return true;
}

void CsvMetadataReader::known_key(const std::string& key, std::string_view value, std::size_t line,
                                  std::size_t column) {
  const auto refuse = [&](const char* wanted) {
    diagnostics_.add(line, column, not_understood(key, value, wanted));
  };
  if (csv_is_setup_key(key)) {
    const std::string wrong = csv_take_setup(key, value, known.set_ups);
    if (!wrong.empty()) return diagnostics_.add(line, column, wrong);
    known.set_up_places.try_emplace(csv_setup_number(key), CsvKnownMetadata::Place{line, column});
  } else if (key == "x_convention") {
    if (value != "radius" && value != "diameter") return refuse("radius or diameter");
    known.diameter = value == "diameter";
    known.diameter_line = line;
  } else if (key == "reading") {
    if (value != "absolute" && value != "relative") return refuse("absolute or relative");
    known.indication = value == "relative" ? Indication::relative : Indication::absolute;
  } else if (key == "nominal_radius") {
    const auto radius_mm = parse_length_mm(value);
    if (!radius_mm || !(*radius_mm > 0.0)) return refuse("a length above zero, such as 14.5 mm");
    known.nominal_radius_mm = radius_mm;
  } else if (key == "sensor_noise") {
    const auto noise_mm = parse_length_mm(value);
    if (!noise_mm || *noise_mm < 0.0) return refuse("a standard deviation, such as 2 um");
    known.sensor_noise_mm = noise_mm;
  } else if (key == "ball_radius") {
    const auto radius_mm = parse_length_mm(value);
    if (!radius_mm || *radius_mm < 0.0) return refuse("a length, such as 1.5 mm");
    known.ball_radius_mm = radius_mm;
  } else if (key == "sensor_angles") {
    const std::string wrong = csv_take_sensor_angles(value, known.sensor_angles_rad);
    if (!wrong.empty()) return diagnostics_.add(line, column, key + ": " + wrong);
    known.sensor_angles_place = {line, column};
  } else {
    const auto rpm = parse_number(value);
    if (!rpm || !(rpm->unit.empty() || rpm->unit == "rpm")) {
      return refuse("revolutions per minute, signed like C, such as 60");
    }
    known.spindle_rpm = rpm->value;
  }
}

}  // namespace trueaxis
