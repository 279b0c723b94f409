// SPDX-License-Identifier: Apache-2.0
#include "cli/catalogue.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "cli/commands.hpp"

namespace trueaxis::cli {
namespace {

const std::vector<CommandEntry> entries{
    {"Start",
     "init",
     "write commented example files that run: a scenario, a job, a cut, a sweep",
     {"trueaxis init first", "trueaxis simulate first/scenario.toml -o first/stream.csv"},
     "docs/tutorial/first-axis.md",
     add_init},
    {"Start",
     "import",
     "convert another program's recording to a stream, with a job to begin with",
     {"trueaxis import export.csv -o part.csv",
      "trueaxis import probe.txt --columns X=1,C=3,Z=2 -o part.csv"},
     "docs/how-to/prepare-a-recording.md",
     add_import},
    {"Start",
     "run",
     "do the whole job: fit, diagnosis, correction, verdict and report",
     {"trueaxis run part.csv", "trueaxis run shaft.toml -o result"},
     "docs/tutorial/first-axis.md",
     add_run},
    {"Measure",
     "watch",
     "show axis, U and residuals while the readings arrive, then do what run does",
     {"trueaxis watch part.csv", "trueaxis watch - --until-u-um 1 -o part"},
     "docs/how-to/watch-a-measurement.md",
     add_watch},
    {"Measure",
     "fit",
     "fit a surface to a probe stream, or a geometric element to points",
     {"trueaxis fit part.csv --surface cone",
      "trueaxis fit --points points.txt --element cylinder --criterion minimum_zone"},
     "docs/how-to/centre-by-tapping.md",
     add_fit},
    {"Measure",
     "form",
     "evaluate roundness, cylindricity, straightness, flatness, run-out (ISO 1101)",
     {"trueaxis form part.csv", "trueaxis form part.csv --upr 1-50 --tolerance-um RONt=2"},
     "docs/how-to/evaluate-roundness.md",
     add_form},
    {"Measure",
     "spindle",
     "separate the form of the part from the spindle error motion (ISO 230-7)",
     {"trueaxis spindle sensors.csv", "trueaxis spindle direct.csv reversed.csv --json s.json"},
     "docs/how-to/qualify-a-spindle.md",
     add_spindle},
    {"Measure",
     "diagnose",
     "find and name the causes that the ideal fit misses in a stream",
     {"trueaxis diagnose part.csv --surface cone",
      "trueaxis diagnose part.csv --surface cylinder --json d.json --report d.html"},
     "docs/reference/effects.md",
     add_diagnose},
    {"Measure",
     "advise",
     "propose the next measurement, and what each alternative would show",
     {"trueaxis advise part.csv --surface cone",
      "trueaxis advise ball.csv --machine machine.toml -o next.csv"},
     "docs/how-to/plan-a-measurement.md",
     add_advise},
    {"Cut",
     "table",
     "compute the correction table for a fast tool servo",
     {"trueaxis table d.json --target target.toml --preview",
      "trueaxis table d.json --target target.toml -o table.csv"},
     "docs/how-to/re-clamp-and-cut-true.md",
     add_table},
    {"Cut",
     "simulate",
     "probe or cut a part on the virtual lathe",
     {"trueaxis simulate part.toml -o part.csv --truth truth.json",
      "trueaxis simulate --from d.json --compare"},
     "docs/reference/scenario.md",
     add_simulate},
    {"Machine",
     "machine calibrate",
     "estimate the errors of a machine from measurements on it",
     {"trueaxis machine calibrate ball.csv --machine machine.toml -o errors.toml",
      "trueaxis machine calibrate ball.csv bar.csv --machine machine.toml -o errors.toml -v"},
     "docs/how-to/calibrate-a-five-axis-machine.md",
     add_calibrate},
    {"Machine",
     "machine diagnose",
     "find and name the errors that the model of a machine misses",
     {"trueaxis machine diagnose ball.csv --machine machine.toml",
      "trueaxis machine diagnose ball.csv --machine machine.toml --program part.nc"},
     "docs/how-to/calibrate-a-five-axis-machine.md",
     add_machine_diagnose},
    {"Machine",
     "machine compensate",
     "rewrite a program for a machine with errors; only positions change",
     {"trueaxis machine compensate part.nc --machine machine.toml --errors errors.toml -o new.nc",
      "trueaxis machine compensate part.nc --machine machine.toml --errors errors.toml -o new.nc "
      "--arcs-mm 0.01"},
     "docs/how-to/compensate-a-program.md",
     add_compensate},
    {"Machine",
     "machine pose",
     "compute where the tool of a machine with errors is in the part",
     {"trueaxis machine pose positions.csv --machine machine.toml",
      "trueaxis machine pose positions.csv --machine machine.toml --errors errors.toml -o "
      "poses.csv"},
     "docs/reference/machine.md",
     add_pose},
    {"Machine",
     "machine inverse",
     "compute the axis positions that put the tool at given points",
     {"trueaxis machine inverse points.csv --machine machine.toml",
      "trueaxis machine inverse points.csv --machine machine.toml --all -o axes.csv"},
     "docs/reference/machine.md",
     add_inverse},
    {"Machine",
     "machine errors",
     "list the errors of a machine at a position (ISO 230-1), or convert their file",
     {"trueaxis machine errors --machine machine.toml --errors errors.toml --at X=50,A=-35",
      "trueaxis machine errors --machine machine.toml --errors errors.toml --format isg "
      "--output-sign moving_part -o errors.csv"},
     "docs/reference/machine.md",
     add_errors},
    {"Machine",
     "machine import",
     "convert a Denavit-Hartenberg table to a machine file",
     {"trueaxis machine import dh.toml -o machine.toml",
      "trueaxis machine import dh.toml -o machine.toml --errors-output errors.toml"},
     "docs/reference/machine.md",
     add_machine_import},
    {"Machine",
     "machine simulate",
     "measure or cut on a virtual machine of several axes",
     {"trueaxis machine simulate ball.toml -o ball.csv",
      "trueaxis machine simulate cut.toml --program part.nc --json cut.json"},
     "docs/reference/virtual-machine.md",
     add_machine_simulate},
    {"Set-up",
     "setup locators",
     "find where a part is from the six measured locators of its fixture",
     {"trueaxis setup locators locators.toml",
      "trueaxis setup locators locators.toml -o errors.toml --json setup.json"},
     "docs/how-to/locate-a-part-in-a-fixture.md",
     add_setup_locators},
    {"Set-up",
     "setup datums",
     "find where a part is if its datum surfaces have errors",
     {"trueaxis setup datums datums.toml",
      "trueaxis setup datums datums.toml -o errors.toml --decimals 4"},
     "docs/how-to/locate-a-part-in-a-fixture.md",
     add_setup_datums},
    {"Study",
     "study plan",
     "find the length, readings and probe that a required uncertainty needs",
     {"trueaxis study plan --goal-um 1 --free readings_per_revolution=7:200",
      "trueaxis study plan part.toml --goal-um 0.5 --free length_mm=10:80"},
     "docs/how-to/plan-a-measurement.md",
     add_plan},
    {"Study",
     "study sweep",
     "repeat a scenario over a grid and compare with the theoretical limit",
     {"trueaxis study sweep sweep.toml -o result", "trueaxis study sweep sweep.toml --dry-run"},
     "docs/reference/sweep.md",
     add_sweep},
    {"Study",
     "study axis-bias",
     "show how far each effect moves the axis, with and without its model",
     {"trueaxis study axis-bias", "trueaxis study axis-bias part.toml -o result"},
     "docs/evidence/axis_bias.md",
     add_axis_bias},
    {"Reference",
     "effects",
     "list the causes that a diagnosis knows, or explain one",
     {"trueaxis effects", "trueaxis effects part.bow"},
     "docs/reference/effects.md",
     add_effects},
    {"Reference",
     "completion",
     "print the script that completes commands and options in a shell",
     {"trueaxis completion bash > trueaxis.bash", "trueaxis completion zsh > _trueaxis"},
     "docs/reference/command-line.md",
     add_completion},
    {"Reference",
     "man",
     "print the manual page",
     {"trueaxis man > trueaxis.1", "trueaxis man | man -l -"},
     "docs/reference/command-line.md",
     add_man},
};

/// The command of a first word of two, made where it is not there yet.
CLI::App* holder_of(CLI::App& app, const std::string& word, const char* group) {
  for (CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
    if (one->get_name() == word) return one;
  return app.add_subcommand(word, group);
}

}  // namespace

std::span<const CommandEntry> catalogue() { return entries; }

void add_commands(CLI::App& app, int& exit_code) {
  for (const CommandEntry& entry : entries) {
    const std::string name = entry.name;
    const std::size_t blank = name.find(' ');
    CLI::App* parent =
        blank == std::string::npos ? &app : holder_of(app, name.substr(0, blank), entry.group);
    CLI::App* const command = parent->add_subcommand(
        blank == std::string::npos ? name : name.substr(blank + 1), entry.line);
    entry.add(command, exit_code);
    // What prints all it has takes the option as well: a script may give it to every command.
    if (command->get_option_no_throw("--verbose") == nullptr)
      command->add_flag("-v,--verbose")->description("print all details (always so here)");
  }
}

const CommandEntry* entry_of(const CLI::App& command) {
  const auto found = std::ranges::find(
      entries, full_name(command), [](const CommandEntry& one) { return std::string(one.name); });
  return found == entries.end() ? nullptr : &*found;
}

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  if (parent == nullptr) return "";
  const std::string before = full_name(*parent);
  return before + (before.empty() ? "" : " ") + command.get_name();
}

}  // namespace trueaxis::cli
