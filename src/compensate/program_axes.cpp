// SPDX-License-Identifier: Apache-2.0
#include "compensate/program_axes.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis {
namespace {

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

ProgramAxes::ProgramAxes(const Machine& machine) : machine_(machine), nominal_(machine) {
  for (std::size_t i = 0; i < work_offset_count; ++i)
    offsets_[i] = machine.work_offsets[i].value_or(WorkOffset{});
  for (const MachineAxis& axis : machine.axes) {
    axes_ |= nc::only(index_of(axis.name));
    const double along = dot(axis.direction, machine.tool.direction);
    if (is_rotary(axis.name) || std::abs(along) < 1.0 - 1e-9) continue;
    length_axis_ = index_of(axis.name);
    length_sign_ = along > 0.0 ? 1.0 : -1.0;
  }
}

nc::ReadOptions ProgramAxes::read_options(std::optional<double> arc_tolerance_mm) const {
  nc::ReadOptions options;
  options.axes = axes_;
  options.mode = machine_.mode == ProgramMode::tip ? nc::PositionMode::tip : nc::PositionMode::axes;
  if (length_axis_ < axis_count) options.length_axis = length_axis_;
  const bool none =
      std::ranges::none_of(machine_.work_offsets, [](const auto& one) { return one.has_value(); });
  for (std::size_t i = 0; i < work_offset_count; ++i)
    options.work_offsets[i] = machine_.work_offsets[i].has_value() || (none && i == 0);
  for (std::size_t i = 0; i < work_offset_count; ++i) options.zeros[i] = offsets_[i].zero;
  for (const auto& [number, length] : machine_.tool_lengths_mm) options.tools.push_back(number);
  if (!options.tools.empty() && machine_.tool.length_mm != 0.0) options.tools.push_back(0);
  options.start = machine_.start;
  options.arc_tolerance_mm = arc_tolerance_mm;
  return options;
}

const WorkOffset& ProgramAxes::offset(const nc::ModalState& modal) const {
  return offsets_[modal.work_offset];
}

double ProgramAxes::length_mm(const nc::ModalState& modal) const {
  const auto found = machine_.tool_lengths_mm.find(modal.tool);
  return found == machine_.tool_lengths_mm.end() ? machine_.tool.length_mm : found->second;
}

Setting ProgramAxes::setting(const nc::ModalState& modal) const {
  return {offset(modal).bed_from_program, length_mm(modal)};
}

ProgramMode ProgramAxes::mode(const nc::ModalState& modal) const {
  return modal.length == nc::LengthOffset::tip ? ProgramMode::tip : machine_.mode;
}

bool ProgramAxes::length_without_axis(const nc::ModalState& modal) const {
  return length_axis_ == axis_count && modal.length == nc::LengthOffset::along_axis &&
         mode(modal) == ProgramMode::axes;
}

std::optional<AxisPositions> ProgramAxes::positions(const nc::AxisValues& words,
                                                    const nc::ModalState& modal) const {
  const AxisPositions& zero = offset(modal).zero;
  AxisPositions axes{};
  for (std::size_t k = 0; k < axis_count; ++k)
    if (nc::has(axes_, k)) axes[k] = words[k] + zero[k];
  if (mode(modal) == ProgramMode::tip)
    return axes_for_tip(nominal_, {words[0], words[1], words[2]}, axes, setting(modal));
  if (modal.length == nc::LengthOffset::along_axis && length_axis_ < axis_count)
    axes[length_axis_] += length_sign_ * length_mm(modal);
  return axes;
}

AxisPositions ProgramAxes::rotary_positions(const nc::AxisValues& words,
                                            const nc::ModalState& modal) const {
  AxisPositions out{};
  for (std::size_t k = 3; k < axis_count; ++k)
    if (nc::has(axes_, k)) out[k] = words[k] + offset(modal).zero[k];
  return out;
}

AxisPositions ProgramAxes::rotary_start(const nc::Program& program,
                                        const nc::ModalState& modal) const {
  AxisPositions out = rotary_positions({}, modal);
  for (std::size_t k = 3; k < axis_count; ++k)
    if (nc::has(axes_, k) && !std::isnan(program.start_words[k]))
      out[k] = program.start_words[k] + offsets_[0].zero[k];
  return out;
}

nc::AxisValues ProgramAxes::words(const nc::AxisValues& words_from, const AxisPositions& from,
                                  const AxisPositions& to, const nc::ModalState& modal) const {
  if (from == to) return words_from;
  nc::AxisValues out = words_from;
  for (std::size_t k = 0; k < axis_count; ++k)
    if (nc::has(axes_, k)) out[k] += to[k] - from[k];
  if (mode(modal) != ProgramMode::tip) return out;
  const Vector3 tip = nominal_.nominal(to, setting(modal)).tip_mm;
  std::ranges::copy(tip, out.begin());
  return out;
}

}  // namespace trueaxis
