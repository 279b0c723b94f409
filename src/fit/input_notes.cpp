// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/counted.hpp"
#include "fit/describe.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double few_degrees = 30.0;  // nobody probes less of a part whose axis is asked for

/// "in 5 sections" where Z stands still for several readings, else nothing.
std::string in_sections(std::vector<double> z) {
  constexpr double one_section_mm = 1e-3;
  std::ranges::sort(z);
  std::size_t sections = 1;
  for (std::size_t i = 1; i < z.size(); ++i) sections += z[i] - z[i - 1] > one_section_mm ? 1 : 0;
  return 3 * sections <= z.size() ? fmt::format(" in {} sections", sections) : "";
}

std::string unused_position(const ProbeStream& stream) {
  const auto [low, high] = range_of(stream.position_mm);
  if (!(high > low)) return "";
  return fmt::format(
      "Z is not used: {} from Z = {:.6g} to {:.6g} mm{} are fitted as one section; taper and tilt "
      "between them count as noise (for one section, write a stream at one Z)",
      counted(stream.size(), "reading"), low, high, in_sections(stream.position_mm));
}

/// C in radians under a header that says degrees, or the other way round.
std::string unit_of_angle(const ProbeStream& stream) {
  const auto [low, high] = range_of(stream.c_rad);
  std::size_t long_steps = 0;
  for (std::size_t i = 1; i < stream.size(); ++i)
    long_steps += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]) > 0.5 * two_pi;
  const double turns = (high - low) / two_pi;
  if (stream.size() > 1 && 2 * long_steps >= stream.size() - 1) {
    return fmt::format(
        "C runs over {:.4g} turns in {}, mostly more than half a turn between readings: if it is "
        "in degrees, write C[deg]",
        turns, counted(stream.size(), "reading"));
  }
  if (360.0 * turns < few_degrees) {
    return fmt::format(
        "C covers only {:.3g}° of the part: if it is in radians, write C[rad], if in turns, C[rev]",
        360.0 * turns);
  }
  return "";
}

/// C that creeps through part of a turn while Z runs to and fro: each is in the other's column.
std::string exchanged_columns(const ProbeStream& stream) {
  constexpr int least_returns = 3;
  if (stream.kind == StreamKind::face || !stream.has_position() || stream.size() < 2) return "";
  const auto [low, high] = range_of(stream.position_mm);
  const auto [from, to] = range_of(stream.c_rad);
  int returns = 0;
  bool creeps = true;
  const double sense = stream.c_rad.back() - stream.c_rad.front();
  for (std::size_t i = 1; i < stream.size(); ++i) {
    creeps = creeps && (stream.c_rad[i] - stream.c_rad[i - 1]) * sense > 0.0;
    returns += std::abs(stream.position_mm[i] - stream.position_mm[i - 1]) > 0.5 * (high - low);
  }
  if (!creeps || to - from >= two_pi || returns < least_returns) return "";
  return fmt::format(
      "C runs once through {:.3g}° while Z jumps {} times through its whole range: are the columns "
      "C and Z exchanged?",
      (to - from) / rad_per_deg, returns);
}

}  // namespace

std::string gross_readings(const ProbeStream& stream) {
  // Of a straight-sided surface the farthest reading is hardly farther from the median than nine in
  // ten are: a lost decimal point is, and few readings alone are a mistake, more a step of the
  // part.
  constexpr double far = 10.0;
  constexpr std::size_t most = 3, one_in = 20;
  if (stream.size() < one_in) return "";
  const double middle_mm = median(stream.reading_mm);
  std::vector<double> off_mm;
  off_mm.reserve(stream.size());
  for (const double reading : stream.reading_mm) off_mm.push_back(std::abs(reading - middle_mm));
  std::vector<double> sorted = off_mm;
  const auto usual = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10);
  std::ranges::nth_element(sorted, usual);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < off_mm.size() && rows.size() <= most; ++i)
    if (*usual > 0.0 && off_mm[i] > far * *usual) rows.push_back(i + 1);
  if (rows.empty() || rows.size() > most || rows.size() * one_in > stream.size()) return "";
  return fmt::format(
      "row{} {} read{} {:.6g} mm{}, {:.4g} mm from the median of all, while nine readings in ten "
      "lie within {:.3g} mm: correct or remove {}, or reduce the weight of {} with the loss tukey "
      "(--loss tukey, in a job loss = \"tukey\")",
      rows.size() == 1 ? "" : "s", ranges_text(rows), rows.size() == 1 ? "s" : "",
      stream.reading_mm[rows.front() - 1], rows.size() == 1 ? "" : " and the like",
      off_mm[rows.front() - 1], *usual, rows.size() == 1 ? "it" : "them",
      rows.size() == 1 ? "it" : "them");
}

std::vector<std::string> notes_on_input(const ProbeStream& stream, const SurfaceInfo& info) {
  std::vector<std::string> notes = stream.read_as;
  if (!stream.x_convention) return notes;
  const auto add = [&](std::string note) {
    if (!note.empty()) notes.push_back(std::move(note));
  };
  if (stream.x_convention->said_by == SaidBy::nobody) {
    add(fmt::format(
        "TrueAxis assumes that {} is a radius: to confirm, write '# x_convention: radius' (or "
        "diameter) in the stream or x_convention in the job, or give --radius (--diameter)",
        stream.kind == StreamKind::face ? "X" : "X_M"));
  }
  if (!info.needs_position && stream.has_position()) add(unused_position(stream));
  add(unit_of_angle(stream));
  add(exchanged_columns(stream));
  return notes;
}

}  // namespace trueaxis
