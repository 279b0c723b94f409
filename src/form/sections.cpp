// SPDX-License-Identifier: Apache-2.0
#include "form/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "form/exchange.hpp"
#include "form/sampling.hpp"
#include "form/section_trace.hpp"
#include "form/stream_checks.hpp"
#include "math/statistics.hpp"
#include "measure/centre_of_ball.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr double between_sections_mm = 0.01;     // Z of one section has no larger step
constexpr double thickest_of_sections_mm = 0.1;  // a helix runs on
constexpr double least_of_a_section = 8.0;
constexpr std::size_t fewest_sections = 4;  // of a surface
constexpr int carries_a_standard = 15;      // UPR: of a section by itself

/// Where the ball's centre is about the spindle axis, without the spindle's known motion. It runs
/// on a circle if the part is off-centre (Eq. 269a).
class CentrePath {
 public:
  CentrePath(const ProbeStream& stream, const FormOptions& options)
      : stream_(stream),
        options_(options),
        behind_(is_probed_behind(stream)),
        at_zero_mm_(centre_at_zero_mm(stream,
                                      options.ball_radius_mm > 0.0
                                          ? options.ball_radius_mm
                                          : stream.ball_radius_mm.value_or(0.0),
                                      options.bore)) {}

  /// On the rear side a reading is of the point half a turn on.
  double angle_rad(std::size_t i) const {
    return stream_.c_rad[i] + (behind_ ? 0.5 * two_pi : 0.0);
  }

  double distance_mm(std::size_t i) const {
    double x_mm = at_zero_mm_ + stream_.reading_mm[i];
    for (const SpindleOrder& one : options_.spindle)
      x_mm -= one.cos_mm * std::cos(one.order * stream_.c_rad[i]) +
              one.sin_mm * std::sin(one.order * stream_.c_rad[i]);
    return behind_ ? -x_mm : x_mm;
  }

 private:
  const ProbeStream& stream_;
  const FormOptions& options_;
  bool behind_;
  double at_zero_mm_;
};

/// Readings by their Z, where Z stands still long enough; empty: it runs on.
std::vector<std::vector<std::size_t>> by_position(const ProbeStream& stream) {
  std::vector<std::size_t> order(stream.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!stream.has_position()) return {order};
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return stream.position_mm[i]; });
  std::vector<std::vector<std::size_t>> sections;
  double thickest = 0.0, begin = 0.0, before = 0.0;
  for (const std::size_t i : order) {
    const double z = stream.position_mm[i];
    if (sections.empty() || z - before > between_sections_mm) {
      sections.emplace_back();
      begin = z;
    }
    before = z;
    thickest = std::max(thickest, z - begin);
    sections.back().push_back(i);
  }
  const bool helix = thickest > thickest_of_sections_mm ||
                     static_cast<double>(stream.size()) <
                         least_of_a_section * static_cast<double>(sections.size());
  for (auto& section : sections) std::ranges::sort(section);
  return helix ? std::vector<std::vector<std::size_t>>{} : sections;
}

/// Whole turns of C from the first reading on; a rest at the end is not a section.
std::vector<std::vector<std::size_t>> by_turns(const ProbeStream& stream) {
  std::map<double, std::vector<std::size_t>> by_turn;  // of a C that jumps far, few of many turns
  const double from = stream.c_rad.front();
  for (std::size_t i = 0; i < stream.size(); ++i)
    by_turn[std::floor(std::abs(stream.c_rad[i] - from) / two_pi + 1e-9)].push_back(i);
  const double whole = std::abs(stream.c_rad.back() - from) / two_pi;
  const double step = whole / static_cast<double>(stream.size() - 1);
  if (whole + step + 1e-6 < by_turn.rbegin()->first + 1.0) by_turn.erase(by_turn.rbegin()->first);
  std::vector<std::vector<std::size_t>> turns;
  for (auto& [turn, readings] : by_turn) turns.push_back(std::move(readings));
  return turns;
}

bool has_radius(const ProbeStream& stream) {
  return stream.indication == Indication::absolute || stream.nominal_radius_mm.has_value();
}

SectionReadings readings_of(const ProbeStream& stream, const FormOptions& options,
                            const std::vector<std::size_t>& which) {
  SectionReadings section;
  const CentrePath path(stream, options);
  double z = 0.0, low = 1e300, high = -1e300;
  for (const std::size_t i : which) {
    section.angle_rad.push_back(path.angle_rad(i));
    section.distance_mm.push_back(path.distance_mm(i));
    if (stream.has_position()) z += stream.position_mm[i] / static_cast<double>(which.size());
    low = std::min(low, stream.c_rad[i]);
    high = std::max(high, stream.c_rad[i]);
  }
  const double n = static_cast<double>(which.size());
  section.turns = (high - low) / two_pi * (n > 1.0 ? n / (n - 1.0) : 1.0);
  if (stream.has_position()) section.z_mm = z;
  return section;
}

/// Subtracts what cone and tilted axis do between a reading's Z and the section's. Eq. 268.
void take_off_slope(const ProbeStream& stream, const std::vector<std::vector<std::size_t>>& turns,
                    Sections& sections) {
  const auto [low, high] = range_of(stream.position_mm);
  const double middle = 0.5 * (low + high), half = std::max(0.5 * (high - low), 1e-9);
  std::size_t count = 0;
  for (const auto& section : sections.list) count += section.size();
  Exchange::Rows rows(static_cast<Eigen::Index>(count), 6);
  if (rows.rows() <= rows.cols())
    throw InputError(
        stream.source,
        fmt::format("{} readings in whole turns: the form of a cylinder needs at least {}", count,
                    rows.cols() + 1));
  std::vector<double> y;
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < turns.size(); ++s)
    for (std::size_t k = 0; k < turns[s].size(); ++k) {
      const double z = (stream.position_mm[turns[s][k]] - middle) / half;
      const double c = std::cos(sections.list[s].angle_rad[k]);
      const double sine = std::sin(sections.list[s].angle_rad[k]);
      rows.row(row++) << 1.0, z, c, sine, z * c, z * sine;
      y.push_back(sections.list[s].distance_mm[k]);
    }
  const Eigen::VectorXd q = Exchange(rows, Criterion::gaussian)(y).q;
  row = 0;
  for (std::size_t s = 0; s < turns.size(); ++s) {
    SectionReadings& section = sections.list[s];
    for (std::size_t k = 0; k < turns[s].size(); ++k, ++row) {
      const double off = (stream.position_mm[turns[s][k]] - *section.z_mm) / half;
      section.distance_mm[k] -= off * (q[1] + q[4] * rows(row, 2) + q[5] * rows(row, 3));
    }
  }
  sections.pitch_mm =
      (high - low) / std::max(1.0, std::abs(stream.c_rad.back() - stream.c_rad.front()) / two_pi);
  sections.notes.push_back(
      fmt::format("The readings run on a helix of {:.4g} mm per revolution: TrueAxis treats each "
                  "whole turn as a section and subtracts the rise of the associated cone. Form "
                  "that changes along Z within a turn shows as a step where the turn closes",
                  sections.pitch_mm));
}

}  // namespace

SurfaceReadings surface_readings(const ProbeStream& stream, const FormOptions& options) {
  expect_sections(stream);
  SurfaceReadings out;
  const CentrePath path(stream, options);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    out.angle_rad.push_back(path.angle_rad(i));
    out.distance_mm.push_back(path.distance_mm(i));
  }
  out.z_mm = stream.position_mm;
  out.radius_known = has_radius(stream);
  const auto sections = by_position(stream);
  out.turns = static_cast<double>((sections.empty() ? by_turns(stream) : sections).size());
  return out;
}

UprOfSurface upr_of_surface(const ProbeStream& stream, const FormOptions& options) {
  expect_sections(stream);
  if (options.each_turn_by_itself) return {};
  const auto sections = by_position(stream);
  if (!sections.empty()) {
    if (sections.size() < fewest_sections) return {};
    for (const auto& which : sections) {
      const SectionTrace one(readings_of(stream, options, which), true, options.high_upr);
      if (!one.trouble().empty() || highest_order(one.trace()) >= carries_a_standard) return {};
    }
  }
  const SurfaceReadings all = surface_readings(stream, options);
  if (all.turns < 2.0) return {};
  const Trace together = sorted_trace(all.angle_rad, all.distance_mm, two_pi);
  return {std::min(highest_order(together, false), highest_of_surface),
          std::min(highest_order(together), highest_of_surface)};
}

Sections sections_of(const ProbeStream& stream, const FormOptions& options) {
  expect_sections(stream);
  Sections sections;
  sections.radius_known = has_radius(stream);
  auto groups = by_position(stream);
  const bool helix = groups.empty();
  if (helix) groups = by_turns(stream);
  if (helix && groups.size() < 2)
    throw InputError(stream.source,
                     "one whole turn of a helix: Z and C run together, and two lobes cannot be "
                     "told from a tilt; probe the turn at one Z, or at least two turns");
  for (const auto& group : groups) sections.list.push_back(readings_of(stream, options, group));
  if (helix) take_off_slope(stream, groups, sections);
  return sections;
}

}  // namespace trueaxis::form
