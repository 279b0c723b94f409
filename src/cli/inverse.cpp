// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "base/counted.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "machine/files/positions_csv.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

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
  const MachineModel model(file.machine);
  const Setting setting = options.machine.setting_of(file.machine);
  const auto targets = read_tool_targets_csv(options.targets);
  const auto solutions = solve(model, targets, setting, options.all);
  return options.output.print_or_write(
      "trueaxis.axes", axes_csv(file.machine, solutions), axes_json(file.machine, solutions),
      {options.machine.machine, options.targets},
      "find the axis positions of " + counted(targets.size(), "point"));
}

}  // namespace

void add_inverse(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<AxesArguments>();
  options->machine.add_machine_to(*command);
  command->add_option("points", options->targets, "tool positions and axes (CSV): x,y,z,i,j,k")
      ->required();
  command->add_flag("--all", options->all, "all solutions within the limits (default the nearest)");
  options->machine.add_work_offset_to(*command);
  options->output.add_to(*command, "trueaxis.axes");
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
