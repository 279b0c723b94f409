// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/counted.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"
#include "compensate/files/compensation_files.hpp"
#include "compensate/program_axes.hpp"
#include "format/file.hpp"
#include "format/notes.hpp"
#include "format/outputs.hpp"
#include "nc/program.hpp"
#include "trueaxis/compensation.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct CompensateArguments {
  std::string program, method = "exact", rotary = "moved";
  MachineOptions machine;
  std::optional<double> tolerance_um, arcs_mm;
  CompensationOptions compensation;
  Results results;
  bool verbose = false, check = false;
};

std::vector<CompensationInput> inputs_of(const CompensateArguments& options,
                                         const std::string& program, const MachineFile& machine,
                                         const ErrorsOfFiles& errors) {
  std::vector<CompensationInput> inputs{{options.program, content_hash(program)},
                                        {options.machine.machine, machine.hash}};
  for (std::size_t i = 0; i < errors.hashes.size(); ++i)
    inputs.push_back({options.machine.errors[i], errors.hashes[i]});
  return inputs;
}

int execute(const CompensateArguments& options) {
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.program);
  outputs.reads(options.machine.machine);
  results.name_to(outputs, options.machine.errors);
  MachineFile machine;
  ErrorsOfFiles of_files;
  std::string text;
  all_of({[&] { outputs.check(); }, [&] { machine = options.machine.read_machine(); },
          [&] {
            text = read_file(options.program);
            expect_no_other_program(results["--output"], text, results.force);
          }});
  if (options.check) {
    std::size_t moves = 0;
    const ProgramAxes axes(machine.machine);
    all_of({[&] { of_files = options.machine.read_errors_of(machine); },
            [&] {
              moves = nc::read_program(text, options.program, axes.read_options(options.arcs_mm))
                          .moves.size();
            }});
    return checked(outputs, "rewrite " + counted(moves, "move") + " of " + options.program);
  }
  of_files = options.machine.read_errors_of(machine);
  const MachineModel model(machine.machine, of_files.errors);
  const std::vector<CompensationInput> inputs = inputs_of(options, text, machine, of_files);
  CompensationOptions task = options.compensation;
  if (options.method == "differential") task.method = CompensationMethod::differential;
  if (options.rotary == "all") task.rotary = RotaryUse::all;
  if (options.tolerance_um) task.tolerance_mm = *options.tolerance_um * mm_per_um;
  task.arc_tolerance_mm = options.arcs_mm;
  std::optional<Waiting> waiting("compensation of " + options.program);
  const ProgramCompensation result =
      compensate_program(model, std::move(text), options.program, task);
  waiting.reset();
  std::vector<std::string>& remarks = of_files.remarks;
  remarks.insert(remarks.end(), result.remarks.begin(), result.remarks.end());
  if (result.blocks_moved == 0)
    throw InputError(options.program,
                     "moves no axis of the machine: name the program that cuts the part");
  results.write(outputs, "--json",
                [&] { return compensation_json(result, task, inputs, remarks); });
  const bool worse = result.unreachable.empty() && result.comes_out_worse();
  if (result.unreachable.empty() && !worse) outputs.open(results["--output"]).write(result.text);
  outputs.commit();
  if (!result.unreachable.empty()) throw Refusal(unreachable_text(result, options.program));
  if (worse) throw Refusal(options.program + ": " + worse_text(result, task));
  if (results.printed()) return done;
  if (options.verbose)
    std::cout << compensation_text(result, task) << notes_screen(remarks);
  else
    print_screen(with_notes(compensation_screen(result, task), remarks));
  std::cout << results.line("program ", "--output") << results.line("result  ", "--json");
  return done;
}

void add_accuracy(CLI::App& command, CompensateArguments& options) {
  add_option(command, "--method", options.method, one_of({"exact", "differential"}),
             "method, differential is Δq = -J⁻¹ L (default exact)");
  add_option(command, "--rotary", options.rotary, one_of({"moved", "all"}),
             "rotary axes that a block may correct (default moved: those it moves)");
  add_option(command, "--tolerance-um", options.tolerance_um,
             number_in(0.0, true, 1e4, "a length above 0, up to 10000 um"),
             "split G1 blocks: deviation allowed from the way that a block means, µm");
  add_option(command, "--arcs-mm", options.arcs_mm,
             number_in(0.0, true, 1.0, "a length above 0, up to 1 mm"),
             "replace G2 and G3 by chords: deviation allowed from the arc, mm");
  add_option(command, "--decimals", options.compensation.decimals, CLI::Range(0, 15),
             "decimals of changed X Y Z, two more under G20 (default 4)");
  add_option(command, "--angle-decimals", options.compensation.angle_decimals, CLI::Range(0, 15),
             "decimals of changed A B C (default 5)");
  add_coverage_factor(command, options.compensation.coverage_factor);
  add_threads(command, options.compensation.threads);
}

}  // namespace

void add_compensate(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<CompensateArguments>();
  command->add_option("program", options->program, "program of ISO 6983 words")->required();
  options->machine.add_machine_to(*command);
  options->machine.add_errors_to(*command);
  Results& results = options->results;
  results.add(*command, "-o,--output", "", "new program")->required();
  results.add(*command, "--json", "trueaxis.compensation", "result (JSON); - prints it");
  add_accuracy(*command, *options);
  add_usual(*command, options->results.force, options->check, &options->verbose);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
