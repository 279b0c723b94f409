// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A column whose rows are no longer those of the others: C or Z jumps at random while the other
/// goes on as a machine moves, or X_M was sorted. Rows that were sorted or shuffled whole keep
/// their numbers together and pass. Empty: nothing of that kind (theory.md, Eq. 316).
std::string column_out_of_order(const ProbeStream& stream);

}  // namespace trueaxis
