// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// No slip that is not sure, after which no table may be cut: one that is merely in a finding's
/// class, that is not the only one, that has rivals, or beside which a pattern is not explained.
/// One that a reference's diagnosis names goes before one in a class.
extern const JobCheck part_slipped;

/// That the part moved, when and by how much, where that is sure: the axis is that of the part as
/// it now stands.
Reasons moved_part(const IdentifiedJob& job);

/// One slip, its sizes shown by what was read after it, no rival of it, no finding that may be
/// another, and nothing unexplained.
bool is_sure_slip(const Diagnosis& diagnosis);

}  // namespace trueaxis
