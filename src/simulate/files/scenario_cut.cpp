// SPDX-License-Identifier: Apache-2.0
#include "simulate/files/scenario_cut.hpp"

#include <numbers>

namespace trueaxis {
namespace {

using namespace virtual_lathe;

CutTarget read_target(TomlTable table) {
  CutTarget target;
  target.kind = table.choice<CutKind>(
      "kind", {{"cylinder", CutKind::cylinder}, {"cone", CutKind::cone}, {"face", CutKind::face}},
      CutKind::cylinder);
  const bool face = target.kind == CutKind::face;
  target.start_mm = table.required_number(face ? "x_start_mm" : "z_start_mm");
  target.end_mm = table.required_number(face ? "x_end_mm" : "z_end_mm");
  if (target.start_mm == target.end_mm) {
    table.complain(face ? "x_end_mm" : "z_end_mm", "equals the start: give the cut a length");
  }
  if (face) {
    target.z_face_mm = table.required_number("z_face_mm");
    return target;
  }
  target.bore = table.flag("bore", false);
  target.radius_mm = table.required_number("radius_mm", Range::positive());
  if (target.kind == CutKind::cone) {
    constexpr double right_angle = 0.5 * std::numbers::pi;
    target.half_angle_rad =
        table.required_number("half_angle_rad", Range::inside(-right_angle, right_angle));
  }
  return target;
}

CutTool read_tool(TomlTable table) {
  CutTool tool;
  tool.nose_radius_mm = table.number("nose_radius_mm", 0.0, Range::non_negative());
  tool.height_mm = table.number("height_mm", 0.0);
  tool.angle_from_probe_rad = table.number("angle_from_probe_rad", 0.0);
  tool.speed_rpm = table.number("speed_rpm", tool.speed_rpm, Range::positive());
  tool.sense = static_cast<int>(table.integer("sense", 1, -1, 1));
  if (tool.sense == 0) table.complain("sense", "must be 1 or -1");
  tool.feed_mm_per_rev = table.number("feed_mm_per_rev", tool.feed_mm_per_rev, Range::positive());
  tool.c_start_rad = table.number("c_start_rad", 0.0);
  return tool;
}

CutActuator read_actuator(TomlTable table) {
  CutActuator actuator;
  actuator.perfect = table.flag("perfect", false);
  actuator.natural_frequency_hz =
      table.number("natural_frequency_hz", actuator.natural_frequency_hz, Range::positive());
  actuator.damping = table.number("damping", actuator.damping, Range::positive());
  actuator.delay_s = table.number("delay_s", 0.0, Range::non_negative());
  actuator.sampling_hz = table.number("sampling_hz", actuator.sampling_hz, Range::positive());
  return actuator;
}

}  // namespace

CutProgram read_cut_program(TomlTable table) {
  CutProgram cut;
  cut.use = table.choice<CutUse>(
      "use", {{"command", CutUse::command}, {"wanted", CutUse::wanted}, {"none", CutUse::none}},
      CutUse::command);
  cut.table = table.maybe_path("table").value_or("");
  cut.target = read_target(table.required_table("target"));
  if (const auto tool = table.maybe_table("tool")) cut.tool = read_tool(*tool);
  if (const auto actuator = table.maybe_table("actuator")) cut.actuator = read_actuator(*actuator);
  return cut;
}

}  // namespace trueaxis
