// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <optional>
#include <utility>

#include "base/counted.hpp"
#include "calibrate/files/machine_diagnosis_files.hpp"
#include "cli/guarded.hpp"
#include "cli/run.hpp"
#include "cli/terminal.hpp"
#include "format/outputs.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "machine/files/errors_files.hpp"
#include "report/machine_report.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

void prepare(Outputs& outputs, const MachineJob& job, const RunMachineOptions& options) {
  const std::string& folder = options.folder;
  for (const JobInput& input : job.inputs) outputs.reads(input.file);
  outputs.into(folder);
  outputs.may_write_in_folder("result.json", "trueaxis.machine_run");
  outputs.may_write_in_folder("report.html", "trueaxis.machine_report");
  outputs.may_write_in_folder("diagnosis.json", "trueaxis.machine_diagnosis");
  outputs.may_write_in_folder("errors.toml", "trueaxis.errors");
  if (job.program) {
    outputs.may_write_in_folder("compensation.json", "trueaxis.compensation");
    outputs.may_write_in_folder(new_program_name(job), "");
  }
  options.results->name_to(outputs);
  outputs.check();
  if (job.program)
    expect_no_other_program(outputs.in_folder(new_program_name(job)), job.program->text,
                            options.force);
}

void write_all(Outputs& outputs, const MachineJobResult& result) {
  outputs.write(outputs.in_folder("result.json"), machine_job_json(result));
  outputs.write(outputs.in_folder("report.html"), render_machine_report(result));
  outputs.write(outputs.in_folder("diagnosis.json"),
                machine_diagnosis_json(result.diagnosis, result.job.machine));
  if (result.implausible.empty())
    outputs.write(outputs.in_folder("errors.toml"),
                  errors_toml(result.errors, &result.job.machine));
  else
    set_aside(outputs, outputs.in_folder("errors.toml"));
  if (result.compensation)
    outputs.write(outputs.in_folder("compensation.json"), job_compensation_json(result));
  if (!result.job.program) return;
  const std::string program = outputs.in_folder(new_program_name(result.job));
  if (result.verdict.go())
    outputs.open(program).write(result.compensation->text);
  else
    set_aside(outputs, program);  // one is there only if it may be run
}

std::string would_do(const MachineJob& job) {
  std::size_t rows = 0;
  for (const MachineMeasurement& one : job.data) rows += one.rows();
  std::string text = "diagnose " + job.machine.name + " by " + counted(rows, "row");
  if (job.program) text += ", rewrite " + job.program->file + " for the errors found";
  return text + (job.tolerance_mm ? ", and decide about the tolerance" : "");
}

}  // namespace

int run_machine(MachineJob job, const RunMachineOptions& options) {
  Outputs outputs(options.force);
  prepare(outputs, job, options);
  if (options.check) return checked(outputs, would_do(job));
  std::optional<Waiting> waiting("diagnosis of " + job.machine.name +
                                 (job.program ? ", its program, the verdict" : ""));
  const MachineJobResult result = run_machine_job(std::move(job));
  CalibrationOptions known;
  known.errors = result.job.known;
  if (const std::string mistake =
          likely_mistake(result.job.machine, result.job.data, known, result.diagnosis.baseline,
                         result.diagnosis.gain.rms_after_mm);
      !mistake.empty())
    throw Refusal(mistake);
  if (!result.diagnosis.baseline.converged) {
    std::cerr << result.job.data.front().source
              << ": not converged: " << result.diagnosis.baseline.message << '\n';
    return numerical;
  }
  write_all(outputs, result);
  options.results->write(outputs, "--json", [&] { return machine_job_json(result); });
  outputs.commit();
  waiting.reset();
  if (options.results->printed()) return result.verdict.go() ? done : refused;
  if (options.verbose)
    std::cout << machine_job_text(result);
  else
    print_screen(machine_job_screen(result));
  if (result.job.program && result.verdict.go())
    std::cout << "program " << outputs.in_folder(new_program_name(result.job)) << '\n';
  else if (result.job.program)
    std::cout << "program not written: the verdict is " << to_string(result.verdict.decision)
              << '\n';
  std::cout << "report  " << outputs.in_folder("report.html") << ", next to it "
            << (result.implausible.empty() ? "errors.toml and " : "") << "the results as JSON\n";
  return result.verdict.go() ? done : refused;
}

}  // namespace trueaxis::cli
