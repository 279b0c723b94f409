// SPDX-License-Identifier: Apache-2.0
#include "job/cut_checks.hpp"

namespace trueaxis {

std::string cut_objection(const JobResult& /*result*/) { return ""; }

std::vector<std::string> cut_reservations(const JobResult& /*result*/) { return {}; }

}  // namespace trueaxis
