// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "base/counted.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "format/notes.hpp"
#include "machine/files/positions_csv.hpp"
#include "machine/limits.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct PoseArguments {
  MachineOptions machine;
  TableOutput output;
  std::string positions;
};

int execute(const PoseArguments& options) {
  const MachineFile file = options.machine.read_machine();
  const ErrorsOfFiles read_errors = options.machine.read_errors_of(file);
  std::cerr << notes_screen(read_errors.remarks);
  const MachineModel model(file.machine, read_errors.errors);
  const Setting setting = options.machine.setting_of(file.machine);
  std::vector<ToolPose> poses;
  std::vector<double> twists_rad;
  for (const AxisPositions& axes : read_positions_csv(options.positions, file.machine)) {
    if (const std::string why = outside_known(model.errors(), axes); !why.empty())
      throw Refusal(options.positions + ": " + why);
    poses.push_back(model.actual(axes, setting));
    twists_rad.push_back(about_tool_axis_rad(poses.back(), model.nominal(axes, setting)));
  }
  const std::string text = poses_csv(poses, twists_rad);
  std::vector<std::string> read = options.machine.errors;
  read.insert(read.end(), {options.machine.machine, options.positions});
  const Json rows = list_of_first(poses.size(), [&](std::size_t i) {
    return Json{{"tip_mm", poses[i].tip_mm},
                {"direction", poses[i].direction},
                {"twist_deg", twists_rad[i] / rad_per_deg}};
  });
  return options.output.print_or_write(
      "trueaxis.poses", text, rows, read,
      "say where the tool is in " + counted(poses.size(), "position"));
}

}  // namespace

void add_pose(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<PoseArguments>();
  options->machine.add_machine_to(*command);
  command->add_option("positions", options->positions, "axis positions (CSV): X[mm],A[deg]…")
      ->required();
  options->machine.add_errors_to(*command);
  options->machine.add_work_offset_to(*command);
  options->output.add_to(*command, "trueaxis.poses");
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
