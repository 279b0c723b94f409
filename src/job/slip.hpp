// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Why no table may be cut after a slip that is not sure: one that is merely in a finding's class,
/// that is not the only one, that has rivals, or beside which a pattern is not explained. One that
/// a reference's diagnosis names goes before one in a class; empty: no diagnosis has any such.
std::string slip_objection(const JobResult& result);

/// That the part moved, when and by how much, where that is sure: the axis is that of the part as
/// it now stands. Empty: it did not.
std::string moved_part(const JobResult& result);

/// Takes the numbers of the axis out of the fit of every reference whose slip is not sure: none is
/// where the part stands now. Those of its shape stay.
void withhold_axes(JobResult& result);

}  // namespace trueaxis
