// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>

#include "simulate/machine/files/machine_scenario_files.hpp"

namespace trueaxis {
namespace {

using virtual_machine::MeasuredRow;
using virtual_machine::MeasurementKind;

constexpr const char* kinds[] = {"ball", "bar", "array", "axis"};

double in_file(AxisName axis, double value) {
  return is_rotary(axis) ? value / rad_per_deg : value;
}

std::vector<AxisName> read_axes(const Machine& machine, bool rotary_too) {
  std::vector<AxisName> out;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const auto axis = static_cast<AxisName>(i);
    if (machine.find(axis) && (rotary_too || !is_rotary(axis))) out.push_back(axis);
  }
  return out;
}

std::string header(MeasurementKind kind, AxisName axis, const std::vector<AxisName>& axes) {
  const char* unit = is_rotary(axis) ? "deg" : "mm";
  if (kind == MeasurementKind::axis) return fmt::format("command[{0}],actual[{0}]\n", unit);
  std::string text = kind == MeasurementKind::array ? "ball,s[mm]" : "setup,ball";
  for (const AxisName a : axes)
    text += fmt::format(",{}[{}]", letter_of(a), is_rotary(a) ? "deg" : "mm");
  if (kind == MeasurementKind::array) return text + '\n';
  text += kind == MeasurementKind::bar ? ",L[mm]" : ",dX[um],dY[um],dZ[um]";
  return text + ",tool_length[mm],t[s]\n";
}

}  // namespace

std::string measurement_csv(const Machine& machine, const virtual_machine::MeasurementPlan& plan,
                            const std::vector<MeasuredRow>& rows) {
  const bool array = plan.kind == MeasurementKind::array;
  const std::vector<AxisName> axes = read_axes(machine, !array);
  std::string text = "# schema: trueaxis.simulated_measurement/1\n";
  text += fmt::format("# kind: {}\n", kinds[static_cast<int>(plan.kind)]);
  if (plan.noise_mm > 0.0) text += fmt::format("# noise: {:.9g} um\n", plan.noise_mm / mm_per_um);
  if (array || plan.kind == MeasurementKind::axis)
    text += fmt::format("# axis: {}\n", letter_of(plan.axis));
  text += header(plan.kind, plan.axis, axes);
  const auto out = std::back_inserter(text);
  for (const MeasuredRow& row : rows) {
    if (plan.kind == MeasurementKind::axis) {
      fmt::format_to(out, "{:.10g},{:.10g}\n", in_file(plan.axis, row.axes[index_of(plan.axis)]),
                     in_file(plan.axis, row.actual));
      continue;
    }
    if (array)
      fmt::format_to(out, "{},{:.10g}", row.ball, row.along_mm);
    else
      fmt::format_to(out, "{},{}", row.setup, row.ball);
    for (const AxisName axis : axes)
      fmt::format_to(out, ",{:.12g}", in_file(axis, row.axes[index_of(axis)]));
    if (plan.kind == MeasurementKind::bar) fmt::format_to(out, ",{:.12g}", row.length_mm);
    for (std::size_t i = 0; plan.kind == MeasurementKind::ball && i < 3; ++i)
      fmt::format_to(out, ",{:.9g}", row.deviation_mm[i] / mm_per_um);
    if (!array) fmt::format_to(out, ",{:.9g},{:.9g}", plan.tool_length_mm, row.time_s);
    text += '\n';
  }
  return text;
}

}  // namespace trueaxis
