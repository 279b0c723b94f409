// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// Holds streams and ideal fits of a job against each other. Tried are, in this order: C in another
/// unit, of every stream; streams that were exchanged, by the fits; and where axes disagree beyond
/// U the mistakes of mistakes(), one reference after the other. A mistake is named if it takes the
/// disagreement to a fifth and the axes are a thousand times more likely with it. The alternative
/// is surfaces that are out of their common axis as those of parts are.
Agreement hold_together(const IdentifiedJob& job);
extern const JobCheck references_agree;

/// How far two axes are apart, as a reason.
Reason how_apart(const Disagreement& disagreement);

}  // namespace trueaxis
