// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Removes the readings that are not kept from every column. @param kept one per reading
void keep_readings(ProbeStream& stream, const std::vector<bool>& kept);

/// Removes the readings at the end of the sensor's range if it saturates (limits_met): they are not
/// measurements of the part. The stream says in `read_as` how many there were.
void leave_out_limits(ProbeStream& stream);

}  // namespace trueaxis
