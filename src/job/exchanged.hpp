// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// "seat (seat.csv)"
std::string reference_and_file(const JobResult& result, std::size_t reference);

/// That two references have each other's stream: each stream is fitted better, or as well, with the
/// surface of the other. Empty: of none.
std::string exchanged_streams(const JobResult& result);

}  // namespace trueaxis
