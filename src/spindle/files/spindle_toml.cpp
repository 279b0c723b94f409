// SPDX-License-Identifier: Apache-2.0
#include "format/toml_reader.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "spindle/files/spindle_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

void read_sensor(TomlTable table, SpindleJob& job) {
  job.read.sensor_angles_rad = table.numbers("angles_rad");
  std::vector<double> degrees = job.read.sensor_angles_rad;
  for (double& angle : degrees) angle /= rad_per_deg;
  const std::string trouble = csv_sensor_angles_trouble(degrees);
  if (!trouble.empty()) table.complain("angles_rad", trouble);
  job.options.u_angle_rad = table.number("u_angle_rad", default_u_angle_rad, Range::non_negative());
  job.options.u_reindex_rad =
      table.number("u_reindex_rad", default_u_angle_rad, Range::non_negative());
}

}  // namespace

SpindleJob read_spindle_toml(const std::string& path) {
  TomlDocument document(path);
  TomlTable root = document.root();
  SpindleJob job;
  SpindleOptions& options = job.options;
  options.coverage_factor = root.number("coverage_factor", 2.0, Range{0.0, 100.0, true, false});
  options.order_max = static_cast<int>(root.integer("order_max", options.order_max, 2, 1000));
  options.sensitive_rad = root.maybe_number("sensitive_direction_rad");
  options.largest_condition =
      root.number("largest_condition", options.largest_condition, Range{.low = 1.0});
  if (const auto sensor = root.maybe_table("sensor")) read_sensor(*sensor, job);
  for (TomlTable one : root.tables("stream")) job.streams.push_back(one.required_path("stream"));
  if (job.streams.empty())
    root.complain("stream", root.has("stream") ? "is empty: give at least one stream"
                                               : "is missing: add a [[stream]]");
  document.finish();
  job.read.several_sensors = true;
  return job;
}

}  // namespace trueaxis
