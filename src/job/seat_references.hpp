// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Of a job of one stream: a reference for every seat that is found in it, named A, B …, with its
/// readings. A stream of one surface stays as it is. @returns the seats, if there are any
std::optional<Reason> take_every_seat(Job& job, std::vector<ProbeStream>& streams);

}  // namespace trueaxis
