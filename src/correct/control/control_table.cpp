// SPDX-License-Identifier: Apache-2.0
#include "correct/control/control_table.hpp"

#include <algorithm>
#include <cmath>

#include "correct/profile.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

std::size_t nodes_of_turn(double c_step_rad) {
  return static_cast<std::size_t>(std::lround(two_pi / c_step_rad)) + 1;
}

std::size_t nodes_of_length(double length_mm, double step_mm) {
  return static_cast<std::size_t>(std::ceil(std::abs(length_mm) / step_mm - 1e-9)) + 1;
}

CorrectionGrid correction_grid(const Correction& correction, double c_step_rad, double step_mm) {
  const Profile profile(correction.commanded_axis(), correction.target, correction.tool,
                        correction.motions);
  const auto [low, high] = std::minmax(correction.position_start_mm, correction.position_end_mm);
  CorrectionGrid grid;
  grid.angles = nodes_of_turn(c_step_rad);
  const std::size_t positions = std::max<std::size_t>(2, nodes_of_length(high - low, step_mm));
  for (std::size_t j = 0; j < positions; ++j)
    grid.position_mm.push_back(low + (high - low) * static_cast<double>(j) /
                                         static_cast<double>(positions - 1));
  grid.value_mm.resize(positions * grid.angles);
  for (std::size_t j = 0; j < positions; ++j) {
    for (std::size_t i = 0; i + 1 < grid.angles; ++i)
      grid.at(j, i) = profile.at(static_cast<double>(i) * c_step_rad, grid.position_mm[j]);
    grid.at(j, grid.angles - 1) = grid.at(j, 0);
  }
  return grid;
}

double CorrectionGrid::between(double c_rad, double at_position_mm) const {
  const double turns = c_rad / two_pi;
  const double c = (turns - std::floor(turns)) * static_cast<double>(angles - 1);
  const auto i = std::min(static_cast<std::size_t>(c), angles - 2);
  const double step =
      (position_mm.back() - position_mm.front()) / static_cast<double>(position_mm.size() - 1);
  const double p = std::clamp((at_position_mm - position_mm.front()) / step, 0.0,
                              static_cast<double>(position_mm.size() - 1));
  const auto j = std::min(static_cast<std::size_t>(p), position_mm.size() - 2);
  const double v = c - static_cast<double>(i), w = p - static_cast<double>(j);
  return (1.0 - w) * ((1.0 - v) * at(j, i) + v * at(j, i + 1)) +
         w * ((1.0 - v) * at(j + 1, i) + v * at(j + 1, i + 1));
}

namespace {

constexpr double most_grid = 1e6, most_lines = 5e7, most_blocks = 1e6;
constexpr double most_tables = 8, most_points = 200;  // SINUMERIK 828D: MD18342
constexpr double most_plane_points = 10201;           // kw.crosscomp2.max_points, its default

double length_of(const TargetSurface& target) {
  return target.path_end_mm() - target.path_start_mm();
}

double rows_of(const TargetSurface& target, const ToolSetup& tool) {
  return std::abs(length_of(target)) / tool.feed_mm_per_rev * tool.rows_per_revolution;
}

/// A count far beyond the limit is not said: it is a key that is wrong.
std::string too_many(double count, const char* what, double most, std::string_view remedy) {
  if (!(count > most)) return "";
  const std::string of = count < 1e4 * most ? fmt::format("{:.0f} {}, ", count, what) : "";
  return fmt::format("makes {}more than the {:.0f} {}that it can have: {}", of, most,
                     of.empty() ? what + std::string(" ") : "", remedy);
}

}  // namespace

std::string_view to_string(ControlFormat format) {
  constexpr std::string_view names[] = {"grid", "halstreamer", "servo_nc", "sinumerik_cec",
                                        "beckhoff_crosscomp2"};
  return names[static_cast<std::size_t>(format)];
}

std::string objection_to(const ControlTable& table, const TargetSurface& target,
                         const ToolSetup& tool) {
  const double turns = two_pi / table.c_step_rad;
  if (!(std::abs(turns - std::round(turns)) < 1e-6) || turns < 4.0)
    return "has a step of C that does not divide a revolution: use 1, 2 or 5 degrees";
  if (!(table.position_step_mm > 0.0)) return "needs a step along the cut: give one above 0";
  // As nodes_of_turn() and nodes_of_length() count, but for steps of any size.
  const double length_mm = std::abs(length_of(target));
  const double angles = std::round(turns) + 1.0;
  const double places = std::ceil(length_mm / table.position_step_mm - 1e-9) + 1.0;
  const bool face = target.kind == TargetKind::face;
  switch (table.format) {
    case ControlFormat::grid:
      return too_many(angles * places, "values", most_grid, "use larger steps");
    case ControlFormat::halstreamer:
      return too_many(rows_of(target, tool), "lines", most_lines,
                      "raise the feed or lower rows_per_revolution");
    case ControlFormat::servo_nc:
      return too_many(rows_of(target, tool), "blocks", most_blocks,
                      "raise the feed or lower rows_per_revolution");
    case ControlFormat::sinumerik_cec:
      if (face) return "corrects X over C: a face needs Z, which this format does not write yet";
      if (angles > most_points)
        return too_many(angles, "points in a table", most_points, "use a step of 2 degrees");
      return too_many(std::max(1.0, places - 1.0), "tables", most_tables,
                      fmt::format("use bands of {:.4g} mm or longer",
                                  std::ceil(100.0 * length_mm / most_tables) / 100.0));
    case ControlFormat::beckhoff_crosscomp2:
      if (face)
        return "corrects X over C and Z: a face needs a correction of Z, which this format does "
               "not write yet";
      if (std::abs(table.c_step_rad / rad_per_deg - table.position_step_mm) > 1e-9)
        return "has one interval for both axes, as many mm as degrees: give the same number for "
               "both";
      return too_many(angles * places, "points", most_plane_points, "use larger steps");
  }
  return "";
}

MadeControlTable make_control_table(const Correction& correction, const ControlTable& table) {
  expects(objection_to(table, correction.target, correction.tool).empty(),
          "a table within its limits");
  switch (table.format) {
    case ControlFormat::grid:
      return grid_csv(correction, table);
    case ControlFormat::halstreamer:
      return halstreamer_text(correction);
    case ControlFormat::servo_nc:
      return servo_nc(correction, table);
    case ControlFormat::sinumerik_cec:
      return sinumerik_cec(correction, table);
    case ControlFormat::beckhoff_crosscomp2:
      return beckhoff_crosscomp2(correction, table);
  }
  return {};
}

}  // namespace trueaxis
