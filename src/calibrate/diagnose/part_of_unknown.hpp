// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/diagnose/find.hpp"

namespace trueaxis::calibrate_detail {

/// Which of the causes do not get a name: patterns, and what may be part of something unknown (Eqs.
/// 184, 230). @param findings one each of `search.found`
std::vector<bool> parts_of_unknown(const Found& search,
                                   const std::vector<MachineFinding>& findings);

}  // namespace trueaxis::calibrate_detail
