// SPDX-License-Identifier: Apache-2.0
#include "nc/probing/files/probing_limits_toml.hpp"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "format/toml_reader.hpp"

namespace trueaxis {
namespace {

std::pair<double, double> read_range(TomlTable& table, const char* key) {
  if (!table.has(key)) {
    table.complain(key, "is missing: write it as [low, high]");
    return {0.0, 0.0};
  }
  const std::vector<double> ends = table.numbers(key);
  if (ends.size() == 2 && ends[0] < ends[1]) return {ends[0], ends[1]};
  table.complain(key, "must hold two numbers, the smaller first: [low, high]");
  return {0.0, 0.0};
}

void read_probe(TomlTable table, nc::ProbingLimits& limits) {
  limits.kind = table.required_choice<nc::ProbeKind>(
      "kind", {{"touch", nc::ProbeKind::touch}, {"analogue", nc::ProbeKind::analogue}});
  limits.ball_radius_mm = table.number("ball_radius_mm", 0.0, Range::non_negative());
  limits.stylus_radius_mm = table.maybe_number("stylus_radius_mm", Range::positive());
  limits.stylus_length_mm = table.maybe_number("stylus_length_mm", Range::positive());
  limits.feed_mm_per_s = table.required_number("feed_mm_per_s", Range::positive());
  limits.clearance_mm = table.required_number("clearance_mm", Range::positive());
  if (limits.kind == nc::ProbeKind::analogue) {
    limits.rate_hz = table.required_number("rate_hz", Range::positive());
    limits.spin_up_s = table.required_number("spin_up_s", Range::positive());
    return;
  }
  limits.search_mm = table.required_number("search_mm", Range::positive());
  for (const char* key : {"rate_hz", "spin_up_s"})
    if (table.has(key)) table.complain(key, "is of an analogue probe: take it out");
}

/// Another word would move the probe, or end the program, in front of its first move.
bool is_work_offset(const std::string& word) {
  const bool first = word.size() == 3 && word.starts_with("G5") && word[2] >= '4' && word[2] <= '9';
  const bool last = word == "G59.1" || word == "G59.2" || word == "G59.3";  // of LinuxCNC
  const bool settable =
      word.size() == 4 && word >= "G505" && word <= "G599" &&  // of SINUMERIK
      std::ranges::all_of(word.substr(1), [](unsigned char c) { return std::isdigit(c) != 0; });
  return first || last || settable;
}

void read_control(TomlTable table, nc::ProbingLimits& limits) {
  if (const auto offset = table.maybe_text("work_offset")) {
    limits.work_offset = *offset;
    if (!is_work_offset(*offset))
      table.complain("work_offset",
                     "must be a work offset: G54 to G59, G59.1 to G59.3, G505 to G599");
  }
  limits.gcode_system =
      table.choice<char>("gcode_system", {{"A", 'A'}, {"B", 'B'}, {"C", 'C'}}, '\0');
  limits.x_diameter = table.choice<bool>("x", {{"radius", false}, {"diameter", true}}, false);
}

}  // namespace

nc::ProbingLimits parse_probing_limits(std::string_view content, const std::string& path) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  nc::ProbingLimits limits;
  TomlTable axes = root.required_table("limits");
  std::tie(limits.x_low_mm, limits.x_high_mm) = read_range(axes, "x_mm");
  std::tie(limits.z_low_mm, limits.z_high_mm) = read_range(axes, "z_mm");
  limits.speed_rpm = axes.required_number("speed_rpm", Range::positive());
  TomlTable part = root.required_table("part");
  limits.reach_mm = part.required_number("reach_mm", Range::positive());
  limits.front_mm = part.required_number("front_mm");
  limits.bore_radius_mm = part.maybe_number("bore_radius_mm", Range::positive());
  limits.bore_bottom_mm = part.maybe_number("bore_bottom_mm");
  limits.bore_mouth_mm = part.maybe_number("bore_mouth_radius_mm", Range::positive());
  read_probe(root.required_table("probe"), limits);
  if (auto control = root.maybe_table("control")) read_control(*control, limits);
  document.finish();
  return limits;
}

}  // namespace trueaxis
