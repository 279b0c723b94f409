// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// "seat (seat.csv)"
std::string reference_and_file(const JobResult& result, std::size_t reference);

/// "C runs from 0° to 251° (0.698 turns, 0.0174 per mm)"
std::string turns_of(const ProbeStream& stream);

/// That C of a reference is in another unit: then the readings are no surface as they were read,
/// and are one in the other unit. Empty: nothing says so.
std::string wrong_unit_of_c(const JobResult& result, std::size_t reference);

/// That two references have each other's stream: each stream is fitted better, or as well, with the
/// surface of the other. Empty: of none.
std::string exchanged_streams(const JobResult& result);

}  // namespace trueaxis
