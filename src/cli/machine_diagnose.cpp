// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/commands.hpp"
#include "cli/machine_diagnosed.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"

namespace trueaxis::cli {

void add_machine_diagnose(CLI::App* command, int& exit_code) {
  struct Arguments {
    MachineDiagnosed run;
    Results results;
  };
  auto options = std::make_shared<Arguments>();
  MachineDiagnosed& run = options->run;
  Results& results = options->results;
  command
      ->add_option("data", run.data, "measurements (CSV) of kinds ball, bar, array, axis, together")
      ->required();
  run.add_to(*command)->required();
  add_false_alarm(*command, run.false_alarm);
  add_coverage_factor(*command, run.coverage_factor);
  results.add(*command, "-o,--output", "trueaxis.errors", "errors, those given and found (TOML)");
  results.add(*command, "--json", "trueaxis.machine_diagnosis", "result (JSON); - prints it");
  results.add(*command, "--report", "trueaxis.machine_report", "report page (HTML)");
  add_usual(*command, results.force, run.check, &run.verbose);
  command->callback([options, &exit_code] { exit_code = options->run.diagnose(options->results); });
}

}  // namespace trueaxis::cli
