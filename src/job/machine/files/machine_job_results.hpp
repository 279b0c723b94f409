// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis {

/// "blade_compensated.nc" of "…/blade.nc"; empty: the job has no program.
std::string new_program_name(const MachineJob& job);

/// Schema trueaxis.machine_run/1: verdict, where the part stands, ranges, what went in; mm and
/// degrees, each with its unit.
std::string machine_job_json(const MachineJobResult& result);
Json machine_job_object(const MachineJobResult& result);

/// compensation.json of the job. @throws ContractViolation of one without a program
std::string job_compensation_json(const MachineJobResult& result);

/// For a terminal: the verdict's line, findings, program.
std::string machine_job_text(const MachineJobResult& result);

/// The first line of the result.
std::string machine_verdict_line(const MachineJobVerdict& verdict);

/// What to do now, a sentence.
std::string machine_next_words(const MachineJobVerdict& verdict);

}  // namespace trueaxis
