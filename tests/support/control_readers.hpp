// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace trueaxis::testing {

/// Every number of a line; `=`, brackets, letters and commas part them.
inline std::vector<double> numbers_in(std::string line) {
  for (char& c : line)
    if (std::string("0123456789.-").find(c) == std::string::npos) c = ' ';
  std::istringstream in(line);
  std::vector<double> numbers;
  for (std::string word; in >> word;)
    if (word.find_first_of("0123456789") != std::string::npos) numbers.push_back(std::stod(word));
  return numbers;
}

inline std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// X over C and Z as a control has it in its memory: whole degrees apart, mm. Shares nothing with
/// the writer.
struct PlaneOfControl {
  std::map<double, std::vector<double>> by_z;  ///< of a control with bands: by their lower end
  double step_deg = 0.0, last_z = 0.0;
  bool bands = false;

  double on_line(const std::vector<double>& values, double c_deg) const {
    const double at = (c_deg - 360.0 * std::floor(c_deg / 360.0)) / step_deg;
    const auto node = std::min(static_cast<std::size_t>(at), values.size() - 2);
    const double share = at - static_cast<double>(node);
    return (1.0 - share) * values[node] + share * values[node + 1];
  }
  double x_mm(double c_deg, double z) const {
    auto above = by_z.upper_bound(z);
    if (above == by_z.begin()) ++above;
    const auto below = std::prev(above);
    if (bands || above == by_z.end()) return on_line(below->second, c_deg);
    const double share = (z - below->first) / (above->first - below->first);
    return (1.0 - share) * on_line(below->second, c_deg) + share * on_line(above->second, c_deg);
  }
};

inline PlaneOfControl read_grid(const std::string& text) {
  PlaneOfControl plane;
  std::vector<double> z, c;
  for (const std::string& line : lines_in(text)) {
    if (line[0] == '#') continue;
    const std::vector<double> row = numbers_in(line);
    if (z.empty()) {
      z = row;
      continue;
    }
    c.push_back(row[0]);
    for (std::size_t j = 0; j < z.size(); ++j) plane.by_z[z[j]].push_back(row[j + 1] * 1e-3);
  }
  plane.step_deg = c[1] - c[0];
  return plane;
}

/// The tables as the remark before each says they are switched on, by Z.
inline PlaneOfControl read_cec(const std::string& text) {
  PlaneOfControl plane;
  plane.bands = true;
  double band_z = 0.0;
  for (const std::string& line : lines_in(text)) {
    const std::vector<double> n = numbers_in(line);
    if (line.rfind("; table", 0) == 0) band_z = n[1];
    if (line.rfind("$AN_CEC[", 0) == 0) plane.by_z[band_z].push_back(n[2]);
    if (line.rfind("$AN_CEC_STEP[", 0) == 0) plane.step_deg = n[1];
  }
  return plane;
}

/// In 0.1 µm and 0.1 µm or 1e-4°, [Z][C].
inline PlaneOfControl read_crosscomp(const std::string& text) {
  PlaneOfControl plane;
  double interval = 0.0, start = 0.0;
  for (const std::string& line : lines_in(text)) {
    if (line[0] == '#') continue;
    const std::vector<double> n = numbers_in(line);
    if (line.find(".interval ") != std::string::npos) interval = n.back();
    if (line.find("start_position_master2") != std::string::npos) start = n.back();
    if (line.find(".table[") == std::string::npos) continue;
    plane.by_z[(start + interval * n[n.size() - 3]) * 1e-4].push_back(n.back() * 1e-4);
  }
  plane.step_deg = interval * 1e-4;
  return plane;
}

/// A row, block or line of a stream.
struct PointOfControl {
  double c_deg = 0.0, x_mm = 0.0, z_mm = 0.0, f = 0.0;
};

/// `servo_nc`: blocks C X Z F; remarks are not read.
inline std::vector<PointOfControl> read_blocks(const std::string& text, bool diameter) {
  std::vector<PointOfControl> blocks;
  for (std::string line : lines_in(text)) {
    if (line.rfind("G1 ", 0) == 0) line = line.substr(3);
    if (line[0] != 'C') continue;
    const std::vector<double> n = numbers_in(line);
    blocks.push_back({n[0], diameter ? 0.5 * n[1] : n[1], n[2], n[3]});
  }
  return blocks;
}

/// `table.csv`: rev, Z (a face: X), C, wanted, command; x_mm is what is wanted, f the command.
inline std::vector<PointOfControl> read_rows(const std::string& text) {
  std::vector<PointOfControl> rows;
  for (const std::string& line : lines_in(text)) {
    if (line[0] == '#' || line[0] == 'r') continue;
    const std::vector<double> n = numbers_in(line);
    rows.push_back({n[0] * 360.0 + n[2], n[3], n[1], n[4]});
  }
  return rows;
}

/// How far off values at even angles of one revolution are: anywhere, and the centre of a circle.
struct OffOverATurn {
  double largest = 0.0, centre = 0.0;
};

template <class Off>
OffOverATurn over_a_turn(Off off, int count = 1440) {
  OffOverATurn out;
  double cosine = 0.0, sine = 0.0;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.25) / count, value = off(share);
    out.largest = std::max(out.largest, std::abs(value));
    cosine += 2.0 / count * value * std::cos(2.0 * std::acos(-1.0) * share);
    sine += 2.0 / count * value * std::sin(2.0 * std::acos(-1.0) * share);
  }
  out.centre = std::hypot(cosine, sine);
  return out;
}

}  // namespace trueaxis::testing
