// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "format/json.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

std::vector<AxisName> sorted_axes(const Machine& machine) {
  std::vector<AxisName> names;
  for (const MachineAxis& axis : machine.axes) names.push_back(axis.name);
  std::ranges::sort(names);
  return names;
}

std::vector<ErrorName> components(const Machine& machine) {
  std::vector<ErrorName> names;
  for (const AxisName axis : sorted_axes(machine))
    for (std::size_t direction = 0; direction < 6; ++direction)
      names.push_back({true, direction, index_of(axis)});
  return names;
}

/// Of a linear axis its zero; of a rotary one its zero and the two offsets across its letter.
std::vector<ErrorName> locations(const Machine& machine) {
  std::vector<ErrorName> names;
  for (const AxisName axis : sorted_axes(machine)) {
    const std::size_t body = index_of(axis);
    for (std::size_t direction = 0; is_rotary(axis) && direction < 3; ++direction)
      if (direction != body % 3) names.push_back({false, direction, body});
    names.push_back({false, body, body});
  }
  return names;
}

std::vector<ErrorName> further(const ErrorModel& errors, const std::vector<ErrorName>& known) {
  std::vector<ErrorName> names;
  for (const ErrorTerm& term : errors.terms)
    if (!term.name.component && std::ranges::find(known, term.name) == known.end() &&
        std::ranges::find(names, term.name) == names.end())
      names.push_back(term.name);
  return names;
}

Json values(const std::vector<ErrorName>& names, const ErrorModel& errors,
            const AxisPositions& axes) {
  Json json = Json::object();
  for (const ErrorName& name : names) {
    const double value = errors.value(name, axes);
    json[to_string(name)] =
        name.angular() ? with_unit(value / rad_per_deg, "deg") : with_unit(value, "mm");
  }
  return json;
}

std::string lines(const char* title, const std::vector<ErrorName>& names, const ErrorModel& errors,
                  const AxisPositions& axes) {
  std::string text;
  std::size_t shown = 0;
  for (const ErrorName& name : names) {
    const double value = errors.value(name, axes);
    if (value == 0.0) continue;
    ++shown;
    text += fmt::format("  {}  {:12.6f} {}\n", to_string(name),
                        name.angular() ? value * 1e6 : value / mm_per_um,
                        name.angular() ? "µrad" : "µm");
  }
  return fmt::format("{}: {}, of which {} not 0\n", title, names.size(), shown) + text;
}

}  // namespace

std::string errors_json(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
                        const std::vector<std::string>& remarks) {
  const std::vector<ErrorName> location = locations(machine);
  Json at = Json::object();
  for (const AxisName axis : sorted_axes(machine))
    at[std::string(1, letter_of(axis))] =
        with_unit(axes[index_of(axis)] / edge_unit(axis), is_rotary(axis) ? "deg" : "mm");
  const Json json{
      {"schema", "trueaxis.errors_at/1"},
      {"machine", machine.name},
      {"sign", errors.sign == ErrorSign::moving_part ? "moving_part" : "tool_minus_workpiece"},
      {"at", at},
      {"component", values(components(machine), errors, axes)},
      {"location", values(location, errors, axes)},
      {"further", values(further(errors, location), errors, axes)},
      {"remarks", remarks}};
  return json_text(json);
}

std::string errors_text(const Machine& machine, const ErrorModel& errors,
                        const AxisPositions& axes) {
  const std::vector<ErrorName> location = locations(machine);
  return lines("component errors", components(machine), errors, axes) +
         lines("location errors that keep the inverse kinematics' form", location, errors, axes) +
         lines("further location errors", further(errors, location), errors, axes);
}

}  // namespace trueaxis
