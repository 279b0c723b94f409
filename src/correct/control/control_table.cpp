// SPDX-License-Identifier: Apache-2.0
#include "correct/control/control_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "correct/control/correction_grid.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
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
