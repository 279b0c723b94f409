// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Schema trueaxis.run/2: verdict, fits, target axis with what is left at each reference, harmonics
/// of the correction and the actuator's margin.
std::string job_json(const JobResult& result);

/// Rows, harmonics and the actuator's margin of a correction.
Json correction_object(const Correction& correction);

/// Name of the file beside the result that holds the diagnosis of a reference.
std::string diagnosis_file(const Job& job, std::size_t reference);

/// Name of the file with its readings: measured, simulated, what is left.
std::string readings_file(const Job& job, std::size_t reference);

}  // namespace trueaxis
