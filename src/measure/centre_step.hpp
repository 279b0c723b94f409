// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "measure/turn_centres.hpp"

namespace trueaxis {

/// A part that moved at one reading, or seems to.
struct CentreStep {
  std::size_t reading = 0;  ///< the first after it, to within one turn
  double size_mm = 0.0;
  /// A delay of X explains it equally well: the centres turn about the spindle axis with the speed.
  bool may_be_delay = false;
  double delay_s = std::numeric_limits<double>::quiet_NaN();  ///< that delay; NaN without times
};

/// The step after which the centres lie on another line (Eq. 314). It explains three quarters of
/// their scatter about one line, and more than a bend with as many parameters does. None: the
/// centres lie on one line, or on a curve.
/// @param by_chance the probability that noise makes one
std::optional<CentreStep> find_centre_step(const TurnCentres& centres, double by_chance = 1e-3);

/// The step, with what a delay of X explains of it (Eq. 314a).
/// @param value_mm readings, one each; those that are not finite do not count
CentreStep weighed_with_delay(CentreStep step, const ProbeStream& stream,
                              std::span<const double> value_mm);

/// What it says to a user, and what to do.
std::string moved_text(const CentreStep& step);

}  // namespace trueaxis
