// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Asks for the stock where the target lies on the probed length of a reference of its own side
/// (shaft or bore; a face on a face), because only then can be told what the tool meets.
/// @throws InputError that says so, when the job does not state it.
void require_stock(const JobResult& result);

/// Why the table of this job must not be run, seen from the geometry alone: the probed surface, the
/// ball, the target and the stock that was stated. Empty: nothing speaks against it.
std::string cut_objection(const JobResult& result);

/// What the geometry does not forbid and the reader of a go must know, a sentence each.
std::vector<std::string> cut_reservations(const JobResult& result);

}  // namespace trueaxis
