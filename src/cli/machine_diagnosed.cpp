// SPDX-License-Identifier: Apache-2.0
#include "cli/machine_diagnosed.hpp"

#include <iostream>
#include <optional>

#include "base/counted.hpp"
#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "calibrate/files/measurement_csv.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"
#include "format/file.hpp"
#include "format/json.hpp"
#include "format/notes.hpp"
#include "format/outputs.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "machine/files/errors_files.hpp"
#include "report/machine_report.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/program_harm.hpp"

namespace trueaxis::cli {
namespace {

/// All that is read.
struct Read {
  MachineFile file;
  ErrorsOfFiles given;
  std::vector<MachineMeasurement> data;
  std::string program;
};

struct Said {
  MachineDiagnosis found;
  std::optional<ProgramHarm> harm;
  Json program;  ///< null: none
};

/// @throws InputError with what is wrong in any file, or in a place of `results`
Read read_of(const MachineDiagnosed& run, const Results& results, Outputs& outputs) {
  outputs.reads(run.machine.machine);
  for (const std::string& path : run.data) outputs.reads(path);
  for (const std::string& path : run.machine.errors) outputs.reads(path);
  if (!run.program.empty()) outputs.reads(run.program);
  results.name_to(outputs);
  Read read;
  all_of({[&] { read.file = run.machine.read_machine(); },
          [&] {
            if (!run.program.empty()) read.program = read_file(run.program);
          },
          [&] { outputs.check(); }});
  all_of({[&] { read.given = run.machine.read_errors_of(read.file); },
          [&] { read.data = read_measurements(run.data, read.file.machine); }});
  return read;
}

/// The harm with the hash of the program it was weighed on.
Json weighed_object(const ProgramHarm& harm, const std::string& program) {
  Json object = harm_object(harm);
  object["hash"] = content_hash(program);
  return object;
}

/// @throws Refusal of what cannot be right
Said said_of(const MachineDiagnosed& run, const Read& read) {
  const Waiting waiting(run.data.empty() ? "plans of a measurement" : "diagnosis of the machine");
  Said out{{}, std::nullopt, nullptr};
  const Machine& machine = read.file.machine;
  MachineDiagnoseOptions options;
  options.calibration.errors = read.given.errors;
  options.calibration.coverage_factor = run.coverage_factor;
  options.false_alarm = run.false_alarm;
  options.covariances = !run.program.empty();
  if (run.noise_um > 0.0) options.planned_noise_mm = run.noise_um * mm_per_um;
  if (run.data.empty()) {
    out.found = plan_machine(machine, options);
  } else {
    out.found = diagnose_machine(machine, read.data, options);
    expect_no_mistake(machine, read.data, options.calibration, out.found.baseline,
                      out.found.gain.rms_after_mm);
  }
  out.found.remarks.insert(out.found.remarks.end(), read.given.remarks.begin(),
                           read.given.remarks.end());
  if (run.program.empty() || !out.found.baseline.converged) return out;
  out.harm = weigh_on_program(machine, out.found, read.program, run.program);
  out.program = weighed_object(*out.harm, read.program);
  return out;
}

/// The diagnosis as a job without a program, for its page.
MachineJobResult as_job(const MachineDiagnosed& run, const Read& read,
                        const MachineDiagnosis& found) {
  MachineJob job;
  job.machine = read.file.machine;
  job.known = read.given.errors;
  job.remarks_of_known = read.given.remarks;
  job.data = read.data;
  job.false_alarm = run.false_alarm;
  job.name = read.file.machine.name;
  job.inputs.push_back({"machine", run.machine.machine, read.file.hash});
  for (std::size_t i = 0; i < run.machine.errors.size(); ++i)
    job.inputs.push_back({"errors known before", run.machine.errors[i], read.given.hashes[i]});
  for (const MachineMeasurement& one : read.data) {
    job.inputs.push_back({"measurement", one.source, one.input_hash});
    job.path += (job.path.empty() ? "" : ", ") + one.source;
  }
  if (!run.program.empty())
    job.inputs.push_back({"program", run.program, content_hash(read.program)});
  return run_machine_job(std::move(job), found);
}

std::string would_do(const MachineDiagnosed& run, const Read& read) {
  std::size_t rows = 0;
  for (const MachineMeasurement& one : read.data) rows += one.rows();
  std::string text = run.data.empty()
                         ? "plan a measurement of " + read.file.machine.name
                         : "diagnose " + read.file.machine.name + " by " + counted(rows, "row");
  return text + (run.program.empty() ? "" : ", weigh what is found on " + run.program);
}

void write_json(const Results& results, Outputs& outputs, const Said& said,
                const Machine& machine) {
  results.write(outputs, "--json", [&] {
    Json object = machine_diagnosis_object(said.found, machine);
    if (said.harm) object["program"] = said.program;
    return json_text(object);
  });
}

int not_converged(const MachineDiagnosed& run, const MachineDiagnosis& found) {
  std::cerr << run.data.front() << ": not converged: " << found.baseline.message << '\n';
  return numerical;
}

void say_advice(const MachineDiagnosis& found, const std::optional<ProgramHarm>& harm,
                bool verbose) {
  if (verbose)
    std::cout << machine_advice_text(found) << (harm ? harm_text(*harm) : "");
  else
    print_screen(machine_advice_screen(found) + (harm ? harm_screen(*harm) : ""));
}

}  // namespace

CLI::Option* MachineDiagnosed::add_to(CLI::App& command) {
  CLI::Option* const option =
      command.add_option("--machine", machine.machine, "machine (TOML) that was measured")
          ->type_name("FILE")
          ->group(machine_group);
  machine.add_errors_to(command);
  command
      .add_option("--program", program,
                  "program on which every cause and the uncertainty of the tip are weighed")
      ->type_name("FILE")
      ->group(machine_group);
  return option;
}

int MachineDiagnosed::diagnose(const Results& results) const {
  Outputs outputs(results.force);
  const Read read = read_of(*this, results, outputs);
  if (check) return checked(outputs, would_do(*this, read));
  const Said said = said_of(*this, read);
  if (!said.found.baseline.converged) return not_converged(*this, said.found);
  write_json(results, outputs, said, read.file.machine);
  results.write(outputs, "--output",
                [&] { return errors_toml(said.found.errors, &read.file.machine); });
  results.write(outputs, "--report", [&] {
    return render_machine_diagnosis_report(as_job(*this, read, said.found), said.program);
  });
  outputs.commit();
  if (results.printed()) return done;
  if (verbose)
    std::cout << machine_diagnosis_text(said.found) << (said.harm ? harm_text(*said.harm) : "");
  else
    print_screen(machine_diagnosis_screen(said.found) + (said.harm ? harm_screen(*said.harm) : "") +
                 notes_screen(read.given.remarks));
  std::cout << results.line("result ", "--json") << results.line("result ", "--output")
            << results.line("report ", "--report");
  return done;
}

int MachineDiagnosed::advise(const Results& results) const {
  Outputs outputs(results.force);
  const Read read = read_of(*this, results, outputs);
  if (check) return checked(outputs, would_do(*this, read) + ", propose the next measurement");
  const Said said = said_of(*this, read);
  if (!said.found.baseline.converged) return not_converged(*this, said.found);
  if (results.asked("--output") && said.found.next_plan.empty())
    throw Refusal("no plan shows or separates anything more: there are no positions to write");
  write_json(results, outputs, said, read.file.machine);
  results.write(outputs, "--output",
                [&] { return measurement_plan_csv(said.found, read.file.machine); });
  outputs.commit();
  if (results.printed()) return done;
  say_advice(said.found, said.harm, verbose);
  std::cout << results.line("result ", "--json") << results.line("result ", "--output");
  return done;
}

void expect_one_stream(const CLI::App& command, std::size_t streams) {
  if (streams > 1)
    throw CLI::ValidationError("stream", "one stream, or several measurements with --machine");
  expect_none(command, {"--errors", "--sign", "--large-errors"},
              "is for a machine: name it with --machine");
  expect_none(command, {"--program"},
              "is the NC program of a machine: name that with --machine; --control has a probing "
              "program written");
}

int advise_machine_job(const MachineJob& job, const Results& results, Outputs& outputs,
                       bool verbose) {
  MachineDiagnoseOptions options;
  options.calibration.errors = job.known;
  options.false_alarm = job.false_alarm;
  options.covariances = job.program.has_value();
  Said said{diagnose_machine(job.machine, job.data, options), std::nullopt, nullptr};
  MachineDiagnosis& found = said.found;
  expect_no_mistake(job.machine, job.data, options.calibration, found.baseline,
                    found.gain.rms_after_mm);
  if (!found.baseline.converged) {
    std::cerr << job.path << ": not converged: " << found.baseline.message << '\n';
    return numerical;
  }
  if (job.program) {
    said.harm = weigh_on_program(job.machine, found, job.program->text, job.program->file);
    said.program = weighed_object(*said.harm, job.program->text);
  }
  write_json(results, outputs, said, job.machine);
  outputs.commit();
  if (results.printed()) return done;
  say_advice(found, said.harm, verbose);
  std::cout << results.line("result ", "--json");
  return done;
}

}  // namespace trueaxis::cli
