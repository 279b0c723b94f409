// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "simulate/files/scenario_files.hpp"
#include "studies/axis_bias/axis_bias_cases.hpp"
#include "studies/axis_bias/axis_bias_json.hpp"
#include "studies/axis_bias/axis_bias_text.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct AxisBiasArguments {
  std::string scenario, folder;
  Results results;
  bool check = false;
};

int execute(const AxisBiasArguments& options) {
  const std::string& path = options.scenario;
  virtual_lathe::Scenario scenario = study::axis_bias_reference();
  std::string hash = content_hash("");
  if (!path.empty()) {
    const std::string content = read_file(path);
    scenario = parse_scenario_toml(content, path);
    hash = content_hash(content);
    if (scenario.cut) throw InputError(path, "needs a part that is probed, not one that is cut");
  }
  Outputs outputs(options.results.force);
  if (!path.empty()) outputs.reads(path);
  if (!options.folder.empty()) {
    outputs.into(options.folder);
    for (const char* name : {"axis_bias.csv", "axis_bias.json", "axis_bias.md"})
      outputs.may_write_in_folder(name, "trueaxis.axis_bias");
  }
  options.results.name_to(outputs);
  outputs.check();
  const std::vector<study::AxisBiasCase> cases = study::axis_bias_cases(scenario);
  if (options.check)
    return checked(outputs, "probe and fit the part with " + std::to_string(cases.size()) +
                                " effects, one at a time");
  Progress progress(0, cases.size(), "effects");
  std::vector<study::AxisBiasRow> rows;
  for (const study::AxisBiasCase& one : cases) {
    rows.push_back(study::axis_bias_of(scenario, one));
    progress.add(1);
  }
  progress.end();
  if (!options.folder.empty()) {
    outputs.write(outputs.in_folder("axis_bias.csv"), axis_bias_csv(rows));
    outputs.write(outputs.in_folder("axis_bias.json"), axis_bias_json(scenario, rows, hash));
    outputs.write(outputs.in_folder("axis_bias.md"), axis_bias_markdown(rows));
  }
  options.results.write(outputs, "--json", [&] { return axis_bias_json(scenario, rows, hash); });
  outputs.commit();
  if (!options.results.printed()) std::cout << axis_bias_text(rows);
  return done;
}

}  // namespace

void add_axis_bias(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<AxisBiasArguments>();
  command->add_option("scenario", options->scenario,
                      "part and plan (TOML, default those of docs/evidence/axis_bias.md)");
  add_place(*command, "-o,--output", options->folder,
            "folder for axis_bias.csv, .json and .md (default none)");
  add_json(*command, options->results, "trueaxis.axis_bias");
  add_usual(*command, options->results.force, options->check);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
