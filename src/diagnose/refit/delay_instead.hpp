// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnose/refit/relinearised_fit.hpp"

namespace trueaxis::diagnose_detail {

/// A delay of X that explains the readings without a slip.
struct DelayInstead {
  double delay_s = 0.0;  ///< NaN: without a clock
  Rival rival;           ///< of what was found
};

/// The delay that a slip, or anything else that the search found, may be instead (Eq. 94a). It
/// turns the part by an angle that no column about the surface reaches. None: one speed, a delay of
/// an ordinary size, which the search weighs, or the readings refute it.
std::optional<DelayInstead> delay_instead(const IdealModel& ideal, const RelinearisedFit& fit);

}  // namespace trueaxis::diagnose_detail
