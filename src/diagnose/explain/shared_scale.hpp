// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"

namespace trueaxis::diagnose_detail {

/// Whose orders are alike in size: all of a crude part are crude, all of a worn spindle large.
enum class Origin { part, spindle };
std::optional<Origin> origin_of(const Effect& effect);

/// The probabilities of what each term may be, given that the orders of one source are alike in
/// size (Eq. 93a).
void share_scales(std::vector<AmbiguousFinding>& findings);

}  // namespace trueaxis::diagnose_detail
