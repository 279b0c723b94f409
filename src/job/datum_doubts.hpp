// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Why the datum system that the job names is not what a tolerance can be held against: the part
/// slipped while one of several references was probed, or the references of a common datum stand
/// off their one axis by more than the tolerance. Empty: nothing speaks against it.
std::string datum_objection(const JobResult& result);

/// References beside the datum whose axes are farther off it than the tolerance, a sentence each.
std::vector<std::string> datum_reservations(const JobResult& result);

}  // namespace trueaxis
