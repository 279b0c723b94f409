// SPDX-License-Identifier: Apache-2.0
#include "cli/machine_diagnosed.hpp"

#include <iostream>
#include <optional>

#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/measurement_csv.hpp"
#include "cli/expect_no_mistake.hpp"
#include "cli/guarded.hpp"
#include "format/file.hpp"
#include "format/json.hpp"
#include "format/outputs.hpp"
#include "harm/files/harm_files.hpp"
#include "machine/files/errors_toml.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/program_harm.hpp"

namespace trueaxis::cli {
namespace {

struct Said {
  MachineFile file;
  MachineDiagnosis found;
  std::optional<ProgramHarm> harm;
  Json program;  ///< null: none
};

/// @throws Refusal of what cannot be right
Said said_of(const MachineDiagnosed& run) {
  Said out{run.machine.read_machine(), {}, std::nullopt, nullptr};
  const Machine& machine = out.file.machine;
  MachineDiagnoseOptions options;
  options.calibration.errors = run.machine.read_errors_of(out.file);
  options.false_alarm = run.false_alarm;
  options.covariances = !run.program.empty();
  if (run.data.empty()) {
    out.found = plan_machine(machine, options);
  } else {
    const auto data = read_measurements(run.data, machine);
    out.found = diagnose_machine(machine, data, options);
    expect_no_mistake(machine, data, options.calibration, out.found.baseline);
  }
  if (run.program.empty() || !out.found.baseline.converged) return out;
  const std::string text = read_file(run.program);
  out.harm = weigh_on_program(machine, out.found, text, run.program);
  out.program = harm_object(*out.harm);
  out.program["hash"] = content_hash(text);
  return out;
}

int not_converged(const MachineDiagnosed& run, const MachineDiagnosis& found) {
  std::cerr << run.data.front() << ": not converged: " << found.baseline.message << '\n';
  return numerical;
}

}  // namespace

void MachineDiagnosed::add_to(CLI::App& command) {
  command.add_option("--machine", machine.machine,
                     "the machine (TOML) that was measured; no --surface then");
  machine.add_errors_to(command);
  command.add_option("--program", program,
                     "with --machine: a program, on which every effect and the uncertainty of the "
                     "tip are weighed");
}

int MachineDiagnosed::diagnose() const {
  Outputs outputs(force);
  outputs.reads(machine.machine);
  for (const std::string& path : data) outputs.reads(path);
  for (const std::string& path : machine.errors) outputs.reads(path);
  if (!program.empty()) outputs.reads(program);
  outputs.may_write(json, "trueaxis.machine_diagnosis");
  outputs.may_write(errors_output, "trueaxis.errors");
  outputs.check();
  const Said said = said_of(*this);
  if (!said.found.baseline.converged) return not_converged(*this, said.found);
  if (!json.empty()) {
    Json object = machine_diagnosis_object(said.found, said.file.machine);
    if (said.harm) object["program"] = said.program;
    outputs.write(json, json_text(object));
  }
  outputs.write(errors_output, errors_toml(said.found.errors, &said.file.machine));
  outputs.commit();
  if (json == "-" || errors_output == "-") return done;
  std::cout << machine_diagnosis_text(said.found);
  if (said.harm) std::cout << harm_text(*said.harm);
  return done;
}

int MachineDiagnosed::advise() const {
  Outputs outputs(force);
  outputs.reads(machine.machine);
  for (const std::string& path : data) outputs.reads(path);
  for (const std::string& path : machine.errors) outputs.reads(path);
  if (!program.empty()) outputs.reads(program);
  outputs.may_write(json, "trueaxis.machine_diagnosis");
  outputs.may_write(plan_output, "trueaxis.measurement_plan");
  outputs.check();
  const Said said = said_of(*this);
  if (!said.found.baseline.converged) return not_converged(*this, said.found);
  if (!plan_output.empty() && said.found.next_plan.empty())
    throw Refusal("no plan shows or separates anything more: there are no positions to write");
  if (!json.empty()) {
    Json object = machine_diagnosis_object(said.found, said.file.machine);
    if (said.harm) object["program"] = said.program;
    outputs.write(json, json_text(object));
  }
  if (!plan_output.empty())
    outputs.write(plan_output, measurement_plan_csv(said.found, said.file.machine));
  outputs.commit();
  if (json == "-" || plan_output == "-") return done;
  std::cout << machine_advice_text(said.found);
  if (said.harm) std::cout << harm_text(*said.harm);
  return done;
}

}  // namespace trueaxis::cli
