// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "format/toml_reader.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"

namespace trueaxis {
namespace {

using virtual_machine::MeasurementKind;
using virtual_machine::MeasurementPlan;

Vector3 three(const std::vector<double>& list) { return {list[0], list[1], list[2]}; }

std::vector<Vector3> triples(TomlTable& table, const std::string& key) {
  std::vector<Vector3> out;
  for (const std::vector<double>& row : table.rows(key, 3)) out.push_back(three(row));
  return out;
}

/// All combinations of the positions of the axes, the last axis of the chain the fastest; then the
/// same backwards.
constexpr std::size_t most_positions = 1'000'000;

std::vector<AxisPositions> read_positions(TomlTable table, const Machine& machine) {
  std::vector<AxisPositions> all{AxisPositions{}};
  for (const MachineAxis& axis : machine.axes) {
    const std::vector<double> at =
        table.numbers(key_of(axis.name), {.low = axis.low, .high = axis.high});
    if (at.empty()) continue;
    if (all.size() * at.size() > most_positions) {
      table.complain(key_of(axis.name), "makes more than 1000000 positions: leave some out");
      break;
    }
    std::vector<AxisPositions> more;
    for (const AxisPositions& before : all) {
      for (const double position : at) {
        more.push_back(before);
        more.back()[index_of(axis.name)] = position;
      }
    }
    all = std::move(more);
  }
  if (table.flag("and_back", false)) all.insert(all.end(), all.rbegin(), all.rend());
  return all;
}

std::optional<AxisName> axis_named(const std::string& word, const Machine& machine) {
  for (const MachineAxis& axis : machine.axes)
    if (word == std::string(1, letter_of(axis.name))) return axis.name;
  return std::nullopt;
}

void read_axis(TomlTable& table, const Machine& machine, MeasurementPlan& plan) {
  const std::string word = table.required_text("axis");
  const std::optional<AxisName> axis = axis_named(word, machine);
  if (axis) plan.axis = *axis;
  if (!axis && !word.empty())
    table.complain("axis",
                   "is not an axis of the machine " + machine.chain + ": name one of its letters");
}

/// Balls `spacing_mm` apart along a straight bar that begins at the first.
void read_array(TomlTable& table, MeasurementPlan& plan) {
  const auto count = table.integer("balls", 5, 2, 1000);
  const double spacing_mm = table.required_number("spacing_mm", Range::positive());
  Vector3 direction{};
  direction[index_of(plan.axis) % 3] = 1.0;
  if (table.has("direction")) direction = triple(table, "direction");
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0.0)) return table.complain("direction", "has no length");
  if (plan.balls_mm.size() != 1) return table.complain("ball_mm", "names the first ball alone");
  for (long long i = 1; i < count; ++i) {
    Vector3 next = plan.balls_mm.front();
    for (std::size_t k = 0; k < 3; ++k)
      next[k] += static_cast<double>(i) * spacing_mm * direction[k] / length;
    plan.balls_mm.push_back(next);
  }
}

MeasurementPlan read_plan(TomlTable table, const Machine& machine) {
  MeasurementPlan plan;
  plan.kind = table.required_choice<MeasurementKind>("kind", {{"ball", MeasurementKind::ball},
                                                              {"bar", MeasurementKind::bar},
                                                              {"array", MeasurementKind::array},
                                                              {"axis", MeasurementKind::axis}});
  plan.noise_mm = table.number("noise_mm", 0.0, Range::non_negative());
  plan.tool_length_mm = table.number("tool_length_mm", machine.tool.length_mm);
  plan.pace_s = table.number("pace_s", plan.pace_s, Range::positive());
  plan.centred = table.flag("centred", false);
  plan.balls_mm = triples(table, "ball_mm");
  plan.bar_mm = triples(table, "bar_mm");
  if (plan.kind != MeasurementKind::axis && plan.balls_mm.empty() && !table.has("ball_mm"))
    table.complain("ball_mm",
                   "is missing: the centre of each ball, [[x, y, z], …] in the zero position");
  if (plan.kind == MeasurementKind::bar && plan.bar_mm.empty() && !table.has("bar_mm"))
    table.complain("bar_mm", "is missing: from the ball to the tip, [[x, y, z], …]");
  if (plan.kind == MeasurementKind::array || plan.kind == MeasurementKind::axis)
    read_axis(table, machine, plan);
  if (plan.kind == MeasurementKind::array) read_array(table, plan);
  plan.positions = read_positions(table.required_table("positions"), machine);
  if (std::optional<TomlTable> by = table.maybe_table("disturbance"))
    plan.disturbance = read_disturbance(*by, machine, true);
  return plan;
}

}  // namespace

MeasurementScenario read_measurement_toml(const std::string& path) {
  MeasurementScenario out;
  TomlDocument document(path);
  TomlTable root = document.root();
  const auto seed = root.integer("seed", 1, 0);
  TomlTable machine = root.required_table("machine");
  TomlTable measure = root.required_table("measure");
  out.of = read_scenario_machine(machine, measure, document);
  out.plan = read_plan(measure, out.of.machine);
  out.plan.seed = static_cast<std::uint64_t>(seed);
  document.finish();
  return out;
}

}  // namespace trueaxis
