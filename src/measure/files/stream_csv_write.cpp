// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_write.hpp"

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_metadata.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::string metadata_line(const std::string& key, const std::string& value) {
  return std::string("# ").append(key).append(": ").append(value);
}

/// The metadata to write: those of the stream, with known keys that say what the stream's members
/// say.
std::map<std::string, std::string> metadata_to_write(const ProbeStream& stream) {
  std::map<std::string, std::string> out = stream.metadata;
  CsvDiagnostics unread("", 0);
  CsvMetadataReader said(unread);
  for (const auto& [key, value] : stream.metadata) {
    expects(csv_is_key(key), "metadata keys of one word");
    expects(value.find('\n') == std::string::npos && trimmed(value) == value,
            "metadata values of one line without outer blanks");
    said.comment(metadata_line(key, value), 1);
  }
  expects(!unread.any(), "metadata that can be read again");
  const auto set = [&](const char* key, const auto& member, const auto& in_metadata, auto text) {
    if (member == in_metadata) return;
    if (member) {
      out[key] = text(*member);
    } else {
      out.erase(key);
    }
  };
  const auto length = [](double value_mm) { return exact_text(value_mm) + " mm"; };
  set("nominal_radius", stream.nominal_radius_mm, said.known.nominal_radius_mm, length);
  set("sensor_noise", stream.sensor_noise_mm, said.known.sensor_noise_mm, length);
  set("ball_radius", stream.ball_radius_mm, said.known.ball_radius_mm, length);
  set("spindle_rpm", stream.spindle_rpm, said.known.spindle_rpm, exact_text);
  if (stream.sensor_angles_rad != said.known.sensor_angles_rad) {
    out.erase("sensor_angles");
    if (!stream.sensor_angles_rad.empty())
      out["sensor_angles"] = csv_sensor_angles_text(stream.sensor_angles_rad);
  }
  if (stream.indication != said.known.indication.value_or(Indication::absolute)) {
    out["reading"] = stream.indication == Indication::relative ? "relative" : "absolute";
  }
  csv_put_setups(stream, said.known.set_ups, out);
  return out;
}

bool all_finite(const std::vector<double>& column) {
  return std::all_of(column.begin(), column.end(),
                     [](double value) { return std::isfinite(value); });
}

void expect_columns(const ProbeStream& stream) {
  const auto fits = [&](const auto& column) {
    return column.empty() || column.size() == stream.size();
  };
  expects(stream.c_rad.size() == stream.size() && fits(stream.position_mm) && fits(stream.time_s) &&
              fits(stream.pass) && fits(stream.setup),
          "columns of one length");
  expects(stream.sensor_angles_rad.empty()
              ? stream.more_reading_mm.empty()
              : stream.sensor_angles_rad.size() == stream.more_reading_mm.size() + 1,
          "an angle for every sensor");
  for (const auto& column : stream.more_reading_mm)
    expects(column.size() == stream.size() && all_finite(column), "finite readings of one length");
  expects(all_finite(stream.reading_mm) && all_finite(stream.c_rad) &&
              all_finite(stream.position_mm) && all_finite(stream.time_s),
          "finite readings");
  expects(stream.kind == StreamKind::lateral || stream.has_position(), "a face with X");
}

}  // namespace

void write_stream_csv(const ProbeStream& stream, OutputFile& sink, const char* schema) {
  expect_columns(stream);
  const bool face = stream.kind == StreamKind::face;
  const std::map<std::string, std::string> metadata = metadata_to_write(stream);
  std::string text = std::string("## schema: ") + schema + "/1\n";
  for (const auto& [key, value] : metadata) text.append(metadata_line(key, value)) += '\n';
  // Doubling and halving are exact: a file that said diameter stays one, and the same stream.
  const auto convention = metadata.find("x_convention");
  const bool diameter = convention != metadata.end() && convention->second == "diameter";
  const double reading_factor = diameter && !face ? 2.0 : 1.0;
  const double position_factor = diameter && face ? 2.0 : 1.0;
  const std::string x_unit = diameter ? "[mm dia]" : "[mm]";
  const bool numbered = !stream.sensor_angles_rad.empty();
  text += face ? "Z_M[mm]" : (numbered ? "X_M1" : "X_M") + x_unit;
  for (std::size_t k = 0; k < stream.more_reading_mm.size(); ++k)
    text += ",X_M" + std::to_string(k + 2) + x_unit;
  text += csv_is_wrapped(stream.c_rad, two_pi) ? ",C[rad running]" : ",C[rad]";
  if (stream.has_position()) text += face ? ",X" + x_unit : ",Z[mm]";
  if (!stream.time_s.empty()) text += ",t[s]";
  if (!stream.pass.empty()) text += ",pass";
  if (!stream.setup.empty()) text += ",setup";
  text += '\n';

  constexpr std::size_t chunk_bytes = std::size_t{1} << 20U;
  const auto add = [&](auto value) {
    text += ',';
    append_exact(text, value);
  };
  for (std::size_t i = 0; i < stream.size(); ++i) {
    append_exact(text, reading_factor * stream.reading_mm[i]);
    for (const auto& column : stream.more_reading_mm) add(reading_factor * column[i]);
    add(stream.c_rad[i]);
    if (stream.has_position()) add(position_factor * stream.position_mm[i]);
    if (!stream.time_s.empty()) add(stream.time_s[i]);
    if (!stream.pass.empty()) add(stream.pass[i]);
    if (!stream.setup.empty()) add(stream.setup[i]);
    text += '\n';
    if (text.size() >= chunk_bytes) {
      sink.write(text);
      text.clear();
    }
  }
  sink.write(text);
}

void write_stream_csv(const ProbeStream& stream, const std::string& path) {
  OutputFile sink(path);
  write_stream_csv(stream, sink);
  sink.commit();
}

}  // namespace trueaxis
