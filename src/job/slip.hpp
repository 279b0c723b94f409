// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Why no table may be cut after a slip: the part stands no longer where the fit's axis is, that of
/// before. One that a reference's diagnosis names goes before one that is merely in a finding's
/// class; empty: no diagnosis has any.
std::string slip_objection(const JobResult& result);

/// Takes the numbers of the axis out of the fit of every reference that slipped: none is where the
/// part stands now. Those of its shape stay.
void withhold_axes(JobResult& result);

}  // namespace trueaxis
