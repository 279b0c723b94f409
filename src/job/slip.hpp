// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "job/check.hpp"

namespace trueaxis {

/// No slip that is not sure, after which no table may be cut. Such a slip may be what another cause
/// is named for, is not the only one, has rival causes, or leaves a pattern that is not explained.
/// One that a reference's diagnosis names goes before one in a class.
extern const JobCheck part_slipped;

/// That the part moved, when and by how much, where that is sure: the axis is that of the part as
/// it is now.
Reasons moved_part(const IdentifiedJob& job);

/// One slip at an instant, its sizes shown by what was read after it, without rival causes, without
/// a cause that may be another slip, and nothing unexplained. Whether one that lasts has ended, no
/// reading tells.
bool is_sure_slip(const Diagnosis& diagnosis);

/// The same with rival causes, if the axis is within U the same for all of them.
bool leaves_axis_known(const Diagnosis& diagnosis);

/// The reference during which the part slipped after another one may have been probed: where that
/// one was is then not known. None: no part slipped, or the readings of this one say that they are
/// later, in the times of the same file.
std::optional<std::size_t> slipped_since(const IdentifiedJob& job, std::size_t reference);

/// Whether the part moved, more likely than not.
bool is_likely_slip(const Diagnosis& diagnosis);

}  // namespace trueaxis
