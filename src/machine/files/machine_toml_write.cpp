// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "base/text.hpp"
#include "machine/files/machine_toml.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

using fmt::format;

std::string list(const Vector3& v) { return format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string axis_text(const MachineAxis& axis) {
  std::string text =
      format("\n[axes.{}]\ndirection = {}\n", letter_of(axis.name), list(axis.direction));
  if (is_rotary(axis.name)) text += format("point_mm = {}\n", list(axis.point_mm));
  if (std::isfinite(axis.low) && std::isfinite(axis.high))
    text += format("limits_{} = [{}, {}]\n", is_rotary(axis.name) ? "deg" : "mm",
                   axis.low / edge_unit(axis.name), axis.high / edge_unit(axis.name));
  return text;
}

/// a, b, c of Rz(c) Ry(b) Rx(a).
Vector3 angles_zyx(const Matrix3& R) {
  return {std::atan2(R[2][1], R[2][2]), std::atan2(-R[2][0], std::hypot(R[2][1], R[2][2])),
          std::atan2(R[1][0], R[0][0])};
}

std::string offset_text(const Machine& machine, std::size_t i) {
  const WorkOffset& offset = *machine.work_offsets[i];
  Vector3 angles_deg = angles_zyx(offset.bed_from_program.rotation);
  for (double& angle : angles_deg) angle /= rad_per_deg;
  std::string text = format("\n[workpiece.G{}]\norigin_mm = {}\nrotation_deg = {}\n", 54 + i,
                            list(offset.bed_from_program.origin_mm), list(angles_deg));
  std::string zeros;
  for (const MachineAxis& axis : machine.axes)
    if (const double zero = offset.zero[index_of(axis.name)]; zero != 0.0)
      add_to_list(zeros, format("{} = {}", letter_of(axis.name), zero / edge_unit(axis.name)));
  return zeros.empty() ? text : text + "zero = {" + zeros + "}\n";
}

std::string program_text(const Machine& machine) {
  std::string text =
      format("\n[program]\nmode = \"{}\"\n", machine.mode == ProgramMode::axes ? "axes" : "tip");
  std::string words;
  for (const MachineAxis& axis : machine.axes)
    if (const auto word = machine.start[index_of(axis.name)])
      add_to_list(words, format("{} = {}", letter_of(axis.name), *word / edge_unit(axis.name)));
  if (!words.empty()) text += "start = {" + words + "}\n";
  return text + format("\n[compensation]\nmax_rotary_change_deg = {}\n",
                       machine.max_rotary_change_rad / rad_per_deg);
}

}  // namespace

std::string machine_toml(const Machine& machine) {
  std::string text = "# schema: trueaxis.machine/1\nschema = \"trueaxis.machine/1\"\n";
  if (!machine.name.empty()) text += "name = " + quoted(machine.name) + '\n';
  text += "chain = " + quoted(machine.chain) + '\n';
  for (const MachineAxis& axis : machine.axes) text += axis_text(axis);
  text += format("\n[tool]\ngauge_point_mm = {}\ndirection = {}\nlength_mm = {}\n",
                 list(machine.tool.gauge_point_mm), list(machine.tool.direction),
                 machine.tool.length_mm);
  for (const auto& [number, length_mm] : machine.tool_lengths_mm)
    text += format("\n[tools.{}]\nlength_mm = {}\n", number, length_mm);
  for (std::size_t i = 0; i < work_offset_count; ++i)
    if (machine.work_offsets[i]) text += offset_text(machine, i);
  return text + program_text(machine);
}

}  // namespace trueaxis
