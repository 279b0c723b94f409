// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_metadata.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "base/angle.hpp"
#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view prefix = "setup.";

struct SetupKey {
  int number = 0;
  std::string_view what;
};

std::optional<SetupKey> parse_key(std::string_view key) {
  key.remove_prefix(prefix.size());
  const auto number = take_number<int>(key);
  if (!number || !take_word(key, ".")) return {};
  return SetupKey{*number, key};
}

/// The keys after the number, what may be there, and where it goes.
struct Quantity {
  std::string_view what;
  UnitKind quantity;
  double SetUp::*member;
  const char* unit;  ///< as it is written
  const char* wanted;
};
constexpr Quantity quantities[] = {
    {"reindex", UnitKind::angle, &SetUp::reindex_rad, " rad",
     "an angle in deg, rad or rev, such as 70 deg"},
    {"z_shift", UnitKind::length, &SetUp::z_shift_mm, " mm",
     "a length in mm, um, \xC2\xB5m, m or in, such as 12 mm"},
    {"x_jog", UnitKind::length, &SetUp::x_jog_mm, " mm",
     "a length in mm, um, \xC2\xB5m, m or in, such as 0.1 mm"},
    {"clamp_force_ratio", UnitKind::count, &SetUp::clamp_force_ratio, "",
     "the force over that of the first clamping, 0 or more and without unit, such as 0.6"},
};

/// Of an angle that was understood: whether it looks like one in another unit; empty: it does not.
std::string unit_trouble(std::string_view value) {
  constexpr double most_turns = 3.0;  // of steps that add up
  const auto said = number_with_unit(value);
  const auto unit = find_unit(UnitKind::angle, said->unit);
  const double size = std::abs(said->value);
  if (size > most_turns * unit->turn)
    return unit->turn != 360.0 ? " is more than three turns, which looks like degrees: write deg"
                               : " is more than three turns: write it without the whole turns";
  if (unit->turn == 360.0 && is_quarters_in_radians(size))
    return " is quarters of a turn in radians: write rad. If degrees are meant, write them in rev";
  return "";
}

bool is_known(std::string_view key) {
  constexpr std::string_view keys[] = {"x_convention",  "reading",     "nominal_radius",
                                       "sensor_noise",  "spindle_rpm", "ball_radius",
                                       "sensor_angles", "feature"};
  return csv_is_setup_key(key) || std::ranges::find(keys, key) != std::end(keys);
}

std::string not_understood(const std::string& key, std::string_view value, const char* wanted) {
  const bool length = key == "nominal_radius" || key == "sensor_noise" || key == "ball_radius";
  const auto number = number_with_unit(value);
  const bool bare = length && number && number->unit.empty();
  return key + ": " + csv_quoted(value) + (bare ? " has no unit" : " is not understood") +
         ": write " + wanted;
}

}  // namespace

bool csv_is_setup_key(std::string_view key) { return key.starts_with(prefix); }

int csv_setup_number(std::string_view key) { return parse_key(key).value_or(SetupKey{}).number; }

std::string csv_take_setup(std::string_view key, std::string_view value,
                           std::map<int, SetUp>& set_ups) {
  const auto parsed = parse_key(key);
  if (!parsed)
    return "unknown key " + csv_quoted(key) +
           ": write the number of the set-up after setup, such as setup.2.reindex";
  const auto not_understood = [&](const char* wanted) {
    return std::string(key) + ": " + csv_quoted(value) + " is not understood: write " + wanted;
  };
  const bool is_side = parsed->what == "side";
  for (const Quantity& quantity : quantities) {
    if (quantity.what != parsed->what) continue;
    const auto number = quantity_in(value, quantity.quantity);
    if (!number || (quantity.quantity == UnitKind::count && *number < 0.0))
      return not_understood(quantity.wanted);
    if (quantity.quantity == UnitKind::angle) {
      const std::string trouble = unit_trouble(value);
      if (!trouble.empty()) return std::string(key) + ": " + csv_quoted(value) + trouble;
    }
    SetUp& set_up = set_ups[parsed->number];
    set_up.number = parsed->number;
    set_up.*quantity.member = *number;
    return "";
  }
  if (!is_side)
    return "unknown key " + csv_quoted(key) +
           ": a set-up has reindex, z_shift, side, x_jog and clamp_force_ratio";
  if (value != "front" && value != "rear") return not_understood("front or rear");
  SetUp& set_up = set_ups[parsed->number];
  set_up.number = parsed->number;
  set_up.rear = value == "rear";
  return "";
}

void csv_put_setups(const ProbeStream& stream, const std::map<int, SetUp>& stated,
                    std::map<std::string, std::string>& metadata) {
  std::set<int> listed;
  for (const SetUp& set_up : list_set_ups(stream)) {
    listed.insert(set_up.number);
    const auto at = stated.find(set_up.number);
    const SetUp said = at == stated.end() ? SetUp{} : at->second;
    const auto key = [&](std::string_view what) {
      return std::string(prefix).append(std::to_string(set_up.number)).append(".").append(what);
    };
    for (const Quantity& quantity : quantities) {
      const double value = set_up.*quantity.member;
      if (value != said.*quantity.member)
        metadata[key(quantity.what)] = exact_text(value) + quantity.unit;
    }
    if (set_up.rear != said.rear) metadata[key("side")] = set_up.rear ? "rear" : "front";
  }
  std::erase_if(metadata, [&](const auto& entry) {
    return csv_is_setup_key(entry.first) && !listed.contains(csv_setup_number(entry.first));
  });
}

bool csv_is_key(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80U && (std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-');
  });
}

std::string_view csv_known_key(std::string_view comment) {
  const std::size_t hash = comment.find('#'), colon = comment.find(':');
  if (hash == std::string_view::npos || colon == std::string_view::npos || colon < hash) return {};
  const std::string_view written = trimmed(comment.substr(hash + 1, colon - hash - 1));
  return is_known(lower_case(written)) ? written : std::string_view();
}

void csv_refuse_keys_between(const std::vector<CsvKeyBelow>& keys, std::size_t rows,
                             CsvDiagnostics& diagnostics) {
  for (const CsvKeyBelow& one : keys)
    if (one.rows > 0 && one.rows < rows)
      diagnostics.add(one.line, one.column,
                      csv_quoted(one.key) +
                          " is between rows, and a key counts for all of them: put it above the "
                          "header, or give the rows below it a file of their own");
}

void CsvMetadataReader::comment(std::string_view line, std::size_t line_number) {
  const std::size_t hash = line.find('#');
  const std::size_t colon = std::min(line.find(':', hash + 1), line.size());
  const std::string_view written = trimmed(line.substr(hash + 1, colon - hash - 1));
  std::string key = lower_case(written);
  const bool is_known_key = colon < line.size() && is_known(key);
  if (!is_known_key && refuse_trouble(line, hash, line_number)) return;
  if (colon == line.size() || !csv_is_key(written)) return;
  const std::string_view value = trimmed(line.substr(colon + 1));
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
  const std::string_view written = trimmed(text.substr(0, colon));
  if (colon == std::string_view::npos || !is_known(lower_case(written))) {
    refuse_trouble(line, hash, line_number);
  } else {
    diagnostics_.add(
        line_number, csv_character(line, hash),
        csv_quoted(written) + " is after a row, where it is not read: put it on a line of its own");
  }
}

bool CsvMetadataReader::refuse_trouble(std::string_view line, std::size_t hash,
                                       std::size_t line_number) {
  std::string trouble = csv_comment_trouble(line.substr(hash + 1));
  if (trouble.empty()) return false;
  diagnostics_.add(line_number, csv_character(line, trimmed(line.substr(hash + 1))),
                   std::move(trouble));
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
  } else if (key == "feature") {
    if (value != "shaft" && value != "bore") return refuse("shaft or bore");
  } else if (key == "nominal_radius") {
    const auto radius_mm = quantity_in(value, UnitKind::length);
    if (!radius_mm || !(*radius_mm > 0.0)) return refuse("a length above zero, such as 14.5 mm");
    known.nominal_radius_mm = radius_mm;
  } else if (key == "sensor_noise") {
    const auto noise_mm = quantity_in(value, UnitKind::length);
    if (!noise_mm || *noise_mm < 0.0) return refuse("a standard deviation, such as 2 um");
    known.sensor_noise_mm = noise_mm;
  } else if (key == "ball_radius") {
    const auto radius_mm = quantity_in(value, UnitKind::length);
    if (!radius_mm || *radius_mm < 0.0) return refuse("a length, such as 1.5 mm");
    known.ball_radius_mm = radius_mm;
  } else if (key == "sensor_angles") {
    const std::string wrong = csv_take_sensor_angles(value, known.sensor_angles_rad);
    if (!wrong.empty()) return diagnostics_.add(line, column, key + ": " + wrong);
    known.sensor_angles_place = {line, column};
  } else {
    const auto rpm = number_with_unit(value);
    if (!rpm || !(rpm->unit.empty() || rpm->unit == "rpm")) {
      return refuse("revolutions per minute, signed like C, such as 60");
    }
    known.spindle_rpm = rpm->value;
  }
}

}  // namespace trueaxis
