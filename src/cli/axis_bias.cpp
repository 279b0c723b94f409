// SPDX-License-Identifier: Apache-2.0
#include "cli/axis_bias.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/guarded.hpp"
#include "cli/progress.hpp"
#include "format/file.hpp"
#include "simulate/files/scenario_toml.hpp"
#include "studies/axis_bias/axis_bias_cases.hpp"
#include "studies/axis_bias/axis_bias_json.hpp"
#include "studies/axis_bias/axis_bias_text.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

int execute(const std::string& path, const std::string& folder) {
  virtual_lathe::Scenario scenario = study::axis_bias_reference();
  std::string hash = content_hash("");
  if (!path.empty()) {
    const std::string content = read_file(path);
    scenario = parse_scenario_toml(content, path);
    hash = content_hash(content);
    if (scenario.part.kind == virtual_lathe::PartKind::face || scenario.cut)
      throw InputError(path,
                       "needs a cone or cylinder that is probed: the effects are those of X_M");
  }
  const std::vector<study::AxisBiasCase> cases = study::axis_bias_cases(scenario);
  Progress progress(0, cases.size(), "effects");
  std::vector<study::AxisBiasRow> rows;
  for (const study::AxisBiasCase& one : cases) {
    rows.push_back(study::axis_bias_of(scenario, one));
    progress.add(1);
  }
  progress.end();
  std::cout << axis_bias_text(rows);
  if (folder.empty()) return done;
  std::error_code unused;
  std::filesystem::create_directories(folder, unused);
  const std::string csv = axis_bias_csv(rows), json = axis_bias_json(scenario, rows, hash),
                    page = axis_bias_markdown(rows);
  const FileContent files[] = {{folder + "/axis_bias.csv", csv},
                               {folder + "/axis_bias.json", json},
                               {folder + "/axis_bias.md", page}};
  write_files(files);
  return done;
}

}  // namespace

void add_axis_bias(CLI::App& app, int& exit_code) {
  struct Options {
    std::string scenario, folder;
  };
  CLI::App* command = app.add_subcommand(
      "axis-bias", "what each effect does to the axis when the model lacks it, and when it has it");
  auto options = std::make_shared<Options>();
  command->add_option("scenario", options->scenario,
                      "part and plan (TOML); default: those of the catalogue's figures");
  command->add_option("-o,--output", options->folder,
                      "folder for axis_bias.csv, axis_bias.json, axis_bias.md");
  command->callback(
      [options, &exit_code] { exit_code = execute(options->scenario, options->folder); });
}

}  // namespace trueaxis::cli
