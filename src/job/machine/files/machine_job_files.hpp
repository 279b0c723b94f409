// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "format/json.hpp"
#include "trueaxis/machine_job.hpp"
#include "trueaxis/program_harm.hpp"

namespace trueaxis {

/// Whether a job is one of a machine: it has a table [machine], or one that only such a job has.
/// @throws InputError if it is not TOML
bool is_machine_job(std::string_view content, const std::string& path);

/// Reads a job of a machine (docs/reference/machine-job.md) and every file that it names.
/// @throws InputError with every diagnostic of all of them
MachineJob read_machine_job_toml(std::string_view content, const std::string& path);

/// "blade_compensated.nc" of "…/blade.nc"; empty: the job has no program.
std::string new_program_name(const MachineJob& job);

/// Schema trueaxis.machine_run/1: verdict, where the part is, ranges, inputs; mm and degrees, each
/// with its unit.
std::string machine_job_json(const MachineJobResult& result);
Json machine_job_object(const MachineJobResult& result);

/// compensation.json of the job. @throws ContractViolation of one without a program
std::string job_compensation_json(const MachineJobResult& result);

/// For a terminal: the verdict's line, causes, program.
std::string machine_job_text(const MachineJobResult& result);

/// The first line of the result.
std::string machine_verdict_line(const MachineJobVerdict& verdict);

/// What to do now, a sentence.
std::string machine_next_words(const MachineJobVerdict& verdict);

/// The job of a machine in some ten lines for a person: verdict, what to do next, what was found,
/// what was changed, what the numbers rest on. Lines are not broken, their text begins in column 8.
/// The tip's U on it is that of the verdict: without what is not known of where the part is.
std::string machine_job_screen(const MachineJobResult& result);

/// `program` of trueaxis.machine_diagnosis: the file, every effect's largest displacement of the
/// tip with its line, U of the tip now and after every plan; mm and degrees.
Json harm_object(const ProgramHarm& harm);

/// For a terminal: µm.
std::string harm_text(const ProgramHarm& harm);

/// Two lines of it for a screen: what does most, and the tip's U.
std::string harm_screen(const ProgramHarm& harm);

}  // namespace trueaxis
