// SPDX-License-Identifier: Apache-2.0
#include "correct/control/as_read.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number.hpp"
#include "correct/control/control_table.hpp"
#include "correct/deviation.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Calls `each` with every line.
template <class Each>
void for_lines(std::string_view text, Each each) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    each(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

/// Every number of a line, in order.
void numbers_of(std::string_view line, std::vector<double>& numbers) {
  numbers.clear();
  while (!line.empty()) {
    if (const auto value = take_plain_number(line))
      numbers.push_back(*value);
    else
      line.remove_prefix(1);
  }
}

Profile wanted_profile(const Correction& c) {
  return {c.commanded_axis(), c.target, c.tool, c.motions};
}

/// Of a table over C and the position: at every node and between two, along the part of the path
/// from `low_mm` to `high_mm`.
void add_plane(Deviation& worst, const Correction& correction, const CorrectionGrid& read,
               double low_mm, double high_mm) {
  const Profile profile = wanted_profile(correction);
  const auto [from, to] = std::minmax(correction.position_start_mm, correction.position_end_mm);
  const double low = std::max(low_mm, from), high = std::min(high_mm, to);
  if (low > high) return;
  std::vector<double> places{low, high};
  for (std::size_t j = 0; j < read.position_mm.size(); ++j) {
    places.push_back(read.position_mm[j]);
    if (j > 0) places.push_back(0.5 * (read.position_mm[j - 1] + read.position_mm[j]));
  }
  std::erase_if(places, [&](double place) { return place < low || place > high; });
  const std::size_t nodes = read.angles - 1, count = nodes * parts_between(nodes);
  std::vector<double> off_mm(count);
  for (const double place : places) {
    for (std::size_t i = 0; i < count; ++i) {
      const double c_rad = two_pi * static_cast<double>(i) / static_cast<double>(count);
      off_mm[i] = read.between(c_rad, place) - profile.at(c_rad, place);
    }
    add_revolution(worst, off_mm);
  }
}

/// Angles 0 to 360° by a step.
std::size_t angles_of(double step_deg) {
  return static_cast<std::size_t>(std::lround(360.0 / step_deg)) + 1;
}

}  // namespace

Deviation grid_as_read(const Correction& correction, std::string_view text) {
  CorrectionGrid read;
  std::vector<double> numbers;
  std::vector<std::vector<double>> rows;
  for_lines(text, [&](std::string_view line) {
    if (line.starts_with('#')) return;
    numbers_of(line, numbers);
    if (line.starts_with('C'))
      read.position_mm = numbers;
    else
      rows.emplace_back(numbers.begin() + 1, numbers.end());
  });
  read.angles = rows.size();
  read.value_mm.resize(read.angles * read.position_mm.size());
  for (std::size_t i = 0; i < read.angles; ++i)
    for (std::size_t j = 0; j < read.position_mm.size(); ++j)
      read.at(j, i) = rows[i].at(j) * mm_per_um;
  Deviation worst;
  add_plane(worst, correction, read, read.position_mm.front(), read.position_mm.back());
  return worst;
}

Deviation sinumerik_as_read(const Correction& correction, std::string_view text) {
  std::vector<CorrectionGrid> bands;  // each of one table: the same at both of its ends
  std::vector<std::vector<double>> tables;
  std::vector<double> numbers;
  for_lines(text, [&](std::string_view line) {
    numbers_of(line, numbers);
    if (line.starts_with("; table ")) {
      bands.emplace_back().position_mm = {numbers.at(1), numbers.at(2)};
      tables.emplace_back();
    } else if (line.starts_with("$AN_CEC[")) {
      tables.at(static_cast<std::size_t>(numbers.at(0))).push_back(numbers.at(2));
    } else if (line.starts_with("$AN_CEC_STEP[")) {
      bands.at(static_cast<std::size_t>(numbers.at(0))).angles = angles_of(numbers.at(1));
    }
  });
  Deviation worst;
  for (std::size_t band = 0; band < bands.size(); ++band) {
    CorrectionGrid& read = bands[band];
    expects(tables[band].size() == read.angles, "as many points as a turn has steps");
    read.value_mm = tables[band];
    read.value_mm.insert(read.value_mm.end(), tables[band].begin(), tables[band].end());
    add_plane(worst, correction, read, read.position_mm.front(), read.position_mm.back());
  }
  return worst;
}

Deviation beckhoff_as_read(const Correction& correction, std::string_view text) {
  constexpr double unit_mm = 1e-4, unit_deg = 1e-4;
  double interval = 0.0, start = 0.0;
  std::size_t places = 0;
  CorrectionGrid read;
  std::vector<double> numbers;
  for_lines(text, [&](std::string_view line) {
    if (!line.starts_with("kw.crosscomp2.")) return;
    numbers_of(line, numbers);
    const std::string_view key = line.substr(14);
    if (key.starts_with("interval")) interval = numbers.back();
    if (key.starts_with("start_position_master2")) start = numbers.back();
    if (key.starts_with("last_index_master1"))
      read.angles = static_cast<std::size_t>(numbers.back()) + 1;
    if (key.starts_with("last_index_master2"))
      places = static_cast<std::size_t>(numbers.back()) + 1;
    if (key.starts_with("table[")) read.value_mm.push_back(numbers.back() * unit_mm);
  });
  expects(
      read.angles == angles_of(interval * unit_deg) && read.value_mm.size() == read.angles * places,
      "as many points as both axes have intervals");
  for (std::size_t j = 0; j < places; ++j)
    read.position_mm.push_back((start + interval * static_cast<double>(j)) * unit_mm);
  Deviation worst;
  add_plane(worst, correction, read, read.position_mm.front(), read.position_mm.back());
  return worst;
}

Deviation servo_as_read(const Correction& correction, const ControlTable& table,
                        std::string_view blocks) {
  struct Block {
    double c_rad, x_mm, z_mm;
  };
  std::vector<Block> points;
  std::vector<double> numbers;
  const double scale = table.x_is_diameter ? 2.0 : 1.0;
  for_lines(blocks, [&](std::string_view line) {
    if (line.starts_with("G1 ")) line.remove_prefix(3);
    if (!line.starts_with('C')) return;
    numbers_of(line, numbers);
    points.push_back({numbers.at(0) * rad_per_deg, numbers.at(1) / scale, numbers.at(2)});
  });
  const Profile profile = wanted_profile(correction);
  const bool face = correction.target.kind == TargetKind::face;
  const auto per_rev = static_cast<std::size_t>(correction.tool.rows_per_revolution);
  const std::size_t parts = parts_between(per_rev);
  Deviation worst;
  std::vector<double> off_mm(per_rev * parts);
  // The last block ends the cut: the last revolution that is whole starts a row earlier.
  for (const std::size_t revolution : looked_at(profile.revolutions() - 1, off_mm.size())) {
    for (std::size_t i = 0; i < off_mm.size(); ++i) {
      const std::size_t row = revolution * per_rev + i / parts;
      const double share = static_cast<double>(i % parts) / static_cast<double>(parts);
      const auto at = [&](double Block::*word) {
        const double from = points.at(row).*word;
        return from + share * (points.at(row + 1).*word - from);
      };
      const double position = at(face ? &Block::x_mm : &Block::z_mm);
      off_mm[i] = at(face ? &Block::z_mm : &Block::x_mm) - profile.programmed_mm(position) -
                  profile.at(at(&Block::c_rad), position);
    }
    add_revolution(worst, off_mm);
  }
  return worst;
}

Deviation halstreamer_as_read(const Correction& correction, std::string_view text) {
  std::vector<double> held, numbers;
  for_lines(text, [&](std::string_view line) {
    if (line.starts_with('#')) return;
    numbers_of(line, numbers);
    held.push_back(numbers.at(0) * mm_per_um);
  });
  const std::vector<double>& sent = correction.rows.command_mm;
  const auto per_rev = static_cast<std::size_t>(correction.tool.rows_per_revolution);
  const std::size_t parts = parts_between(per_rev), revolutions = sent.size() / per_rev;
  Deviation worst;
  std::vector<double> off_mm(per_rev * parts);
  for (const std::size_t revolution : looked_at(revolutions - 1, off_mm.size())) {
    for (std::size_t i = 0; i < off_mm.size(); ++i) {
      const std::size_t row = revolution * per_rev + i / parts;
      const double share = static_cast<double>(i % parts) / static_cast<double>(parts);
      const double value = sent[row] + share * (sent[row + 1] - sent[row]);
      // Where one line follows the other both are counted: the middle of the step.
      const std::size_t before = share == 0.0 && row > 0 ? row - 1 : row;
      off_mm[i] = 0.5 * (held[before] + held.at(row)) - value;
      worst.largest_mm = std::max(worst.largest_mm, std::abs(held[before] - value));
    }
    add_revolution(worst, off_mm);
  }
  return worst;
}

}  // namespace trueaxis
