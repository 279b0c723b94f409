// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/angle.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr const char* wanted = "write the sensors' angles and one unit, such as 0, 99, 202 deg";

}  // namespace

std::string csv_sensor_angles_trouble(std::span<const double> angles_deg) {
  double largest_deg = 0.0;
  for (std::size_t i = 0; i < angles_deg.size(); ++i) {
    if (!std::isfinite(angles_deg[i]))
      return fmt::format("the angle of sensor {} is not a number", i + 1);
    largest_deg = std::max(largest_deg, std::abs(angles_deg[i]));
    for (std::size_t j = 0; j < i; ++j) {
      if (apart_rad(angles_deg[i] * rad_per_deg, angles_deg[j] * rad_per_deg) < 0.1 * rad_per_deg)
        return fmt::format(
            "sensors {} and {} have the same angle, {:g} deg: two sensors need two angles", j + 1,
            i + 1, angles_deg[i]);
    }
  }
  if (angles_deg.size() > 1 && largest_deg <= two_pi)
    return fmt::format(
        "the angles of the sensors span {:g} deg, which looks like radians: give their angles in "
        "degrees",
        largest_deg);
  return "";
}

std::string csv_take_sensor_angles(std::string_view text, std::vector<double>& angles_rad) {
  angles_rad.clear();
  const std::string not_understood = csv_quoted(text) + " is not understood: " + wanted;
  std::string_view name = text;
  for (;;) {
    name.remove_prefix(std::min(name.find_first_not_of(" \t,;"), name.size()));
    const auto value = take_number<double>(name);
    if (!value) break;
    if (!std::isfinite(*value)) return not_understood;
    angles_rad.push_back(*value);
  }
  name = trimmed(name);
  const auto unit = find_unit(UnitKind::angle, name);
  if (angles_rad.empty()) return not_understood;
  if (name.empty()) return csv_quoted(text) + " has no unit: " + wanted;
  if (!unit) return not_understood;
  const double largest = std::abs(
      *std::ranges::max_element(angles_rad, {}, [](double angle) { return std::abs(angle); }));
  if (unit->turn != 360.0 && largest > 1.01 * unit->turn)
    return csv_quoted(text) + " goes beyond one turn, which looks like degrees: write deg";
  for (double& angle : angles_rad) angle *= unit->factor;
  std::vector<double> degrees = angles_rad;
  for (double& angle : degrees) angle /= rad_per_deg;
  return csv_sensor_angles_trouble(degrees);
}

std::string csv_sensor_angles_text(std::span<const double> angles_rad) {
  return word_list(angles_rad, ", ", exact_text) + " rad";
}

void csv_finish_sensors(const CsvHeader& header, const CsvKnownMetadata& known,
                        const StreamReadOptions& options, ProbeStream& stream,
                        CsvDiagnostics& diagnostics) {
  const std::size_t sensors = header.sensors();
  const auto place = known.sensor_angles_place;
  const CsvColumn* reading = header.find(CsvRole::reading);
  const std::size_t column = reading == nullptr ? 0 : reading->character;
  const bool said = !known.sensor_angles_rad.empty();
  if (sensors == 0) {
    if (said)
      diagnostics.add(place.line, place.column,
                      "sensor_angles are those of columns X_M1, X_M2 …: name the columns so, or "
                      "remove the key");
    return;
  }
  if (!options.several_sensors) {
    diagnostics.add(header.line, column,
                    fmt::format("X_M1 to X_M{} are {} sensors of one recording, for `trueaxis "
                                "spindle`: for this command keep the one at +X and name it X_M",
                                sensors, sensors));
    return;
  }
  stream.sensor_angles_rad = said ? known.sensor_angles_rad : options.sensor_angles_rad;
  const auto& angles = stream.sensor_angles_rad;
  const std::size_t line = said ? place.line : header.line;
  const std::size_t at = said ? place.column : column;
  if (angles.empty()) {
    diagnostics.add(
        line, at,
        fmt::format("the angles of the {} sensors are missing: write '# sensor_angles: 0, 99, 202 "
                    "deg' or give the angles to the command",
                    sensors));
  } else if (angles.size() != sensors) {
    diagnostics.add(line, at,
                    fmt::format("{} angles for {} sensors: give every column X_M1 to X_M{} one",
                                angles.size(), sensors, sensors));
  } else if (said && !options.sensor_angles_rad.empty() &&
             !std::ranges::equal(angles, options.sensor_angles_rad,
                                 [](double a, double b) { return apart_rad(a, b) < 1e-6; })) {
    diagnostics.add(line, at,
                    "sensor_angles in the file differ from those of the caller: correct one");
  }
}

}  // namespace trueaxis
