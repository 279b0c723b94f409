// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "format/notes.hpp"
#include "machine/files/positions_csv.hpp"
#include "machine/limits.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::cli {
namespace {

constexpr double least_left_mm = 1e-5, least_left_rad = 1e-6;  // less is not worth a line

struct AxesArguments {
  MachineOptions machine;
  TableOutput output;
  std::string targets;
  bool all = false;
};

/// The solutions of every point, each nearest to the first of the point before.
std::vector<std::vector<AxisPositions>> solve(const MachineModel& model,
                                              const std::vector<ToolTarget>& targets,
                                              const Setting& setting, bool all) {
  std::vector<std::vector<AxisPositions>> solutions;
  std::string refused;
  AxisPositions near{};
  for (const ToolTarget& target : targets) {
    InverseKinematics found = axes_for(model, target, near, setting);
    if (found.solutions.empty()) {
      refused += fmt::format("{}point {}: {}", refused.empty() ? "" : "\n", solutions.size() + 1,
                             found.why_none);
    } else {
      near = found.solutions.front();
      if (!all) found.solutions.resize(1);
    }
    solutions.push_back(std::move(found.solutions));
  }
  if (!refused.empty()) throw Refusal(refused);
  return solutions;
}

/// What the axes of the machine with its errors cannot put right, the largest of all solutions.
struct Left {
  double tip_mm = 0.0, direction_rad = 0.0;
  bool at_pole = false;   ///< an axis would have to turn much to turn the tool little
  bool at_limit = false;  ///< a rotary axis turns by all that the machine file allows
};

bool turns_by_all(const Machine& machine, const AxisPositions& from, const AxisPositions& to) {
  return std::ranges::any_of(machine.axes, [&](const MachineAxis& axis) {
    const std::size_t k = index_of(axis.name);
    return is_rotary(axis.name) &&
           std::abs(to[k] - from[k]) >= machine.max_rotary_change_rad * (1.0 - 1e-9);
  });
}

/// Puts in the place of every solution of the nominal machine the axes at which the machine with
/// its errors has the tool there.
Left correct(const MachineModel& model, const Setting& setting,
             std::vector<std::vector<AxisPositions>>& solutions) {
  Left left;
  std::string refused;
  for (std::size_t point = 0; point < solutions.size(); ++point) {
    for (AxisPositions& axes : solutions[point]) {
      const CompensatedPosition to = compensate_exactly(model, axes, setting);
      std::string why = outside_known(model.errors(), axes);
      if (why.empty()) why = to.why;
      if (!why.empty())
        refused += fmt::format("{}point {}: {}", refused.empty() ? "" : "\n", point + 1, why);
      left.tip_mm = std::max(left.tip_mm, to.tip_left_mm);
      left.direction_rad = std::max(left.direction_rad, to.direction_left_rad);
      if (to.status == CompensationStatus::singular)
        (turns_by_all(model.machine(), axes, to.axes) ? left.at_limit : left.at_pole) = true;
      axes = to.axes;
    }
  }
  if (!refused.empty()) throw Refusal(refused);
  return left;
}

/// A line if the axes cannot do all: with fewer than two rotary ones the direction.
std::string left_text(const Left& left, const Machine& machine) {
  if (left.tip_mm < least_left_mm && left.direction_rad < least_left_rad) return "";
  const double tip_um = left.tip_mm / mm_per_um, direction_mrad = 1e3 * left.direction_rad;
  if (left.at_limit)
    return fmt::format(
        "note   {:.2g} mrad of the direction stay, as a rotary axis is turned by {:g}° at most: "
        "raise [compensation] max_rotary_change_deg of the machine if it may turn more\n",
        direction_mrad, machine.max_rotary_change_rad / rad_per_deg);
  if (left.at_pole)
    return fmt::format(
        "note   {:.2g} mrad of the direction stay, as the tool is nearly along a rotary axis: this "
        "is turned by twenty times at most what it turns the tool\n",
        direction_mrad);
  return fmt::format(
      "note   the axes cannot correct {} µm at the tip and {:.2g} mrad of the direction\n",
      significant(tip_um, 2), direction_mrad);
}

/// For each point its solutions, an axis in mm or deg by its letter.
Json axes_json(const Machine& machine, const std::vector<std::vector<AxisPositions>>& solutions) {
  return list_of(solutions, [&](const std::vector<AxisPositions>& of_point) {
    return list_of(of_point, [&](const AxisPositions& axes) {
      Json json;
      for (const MachineAxis& axis : machine.axes) {
        const auto index = static_cast<std::size_t>(axis.name);
        json[std::string(1, "XYZABC"[index]) + (index < 3 ? "_mm" : "_deg")] =
            axes[index] / (index < 3 ? 1.0 : rad_per_deg);
      }
      return json;
    });
  });
}

int execute(const AxesArguments& options) {
  const MachineFile file = options.machine.read_machine();
  const ErrorsOfFiles given = options.machine.read_errors_of(file);
  const MachineModel model(file.machine, given.errors);
  const Setting setting = options.machine.setting_of(file.machine);
  const auto targets = read_tool_targets_csv(options.targets);
  auto solutions = solve(model, targets, setting, options.all);
  std::cerr << notes_screen(given.remarks);
  if (!options.machine.errors.empty())
    std::cerr << left_text(correct(model, setting, solutions), file.machine);
  std::vector<std::string> read = options.machine.errors;
  read.insert(read.end(), {options.machine.machine, options.targets});
  return options.output.print_or_write(
      "trueaxis.axes", axes_csv(file.machine, solutions), axes_json(file.machine, solutions), read,
      "find the axis positions of " + counted(targets.size(), "point"));
}

}  // namespace

void add_inverse(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<AxesArguments>();
  options->machine.add_machine_to(*command);
  command->add_option("points", options->targets, "tool positions and axes (CSV): x,y,z,i,j,k")
      ->required();
  command->add_flag("--all", options->all, "all solutions within the limits (default the nearest)");
  options->machine.add_errors_to(*command);
  options->machine.add_work_offset_to(*command);
  options->output.add_to(*command, "trueaxis.axes");
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
