// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "job/files/job_file.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// What the job takes over from the result of the part before, "" for none, and what of the machine
/// must stay as it is.
/// @throws InputError for a result that is not that of a part before on the same machine, with
/// everything that differs
MachineFeedback feedback_before(const JobFile& file, const std::vector<ProbeStream>& streams,
                                const std::string& previous);

/// Learns from the cut that was probed again; nothing if it was not. The table of the job must be
/// that of the cut.
/// @param previous as above
/// @throws InputError naming what the verification contradicts
void learn_from_cut(JobResult& result, const JobFile& file, const std::string& previous);

/// As in result.json.
Json feedback_object(const JobResult& result);

/// Lines "loop" and "cut" of a screen; "" without feedback.
std::string feedback_screen(const JobResult& result);

}  // namespace trueaxis
