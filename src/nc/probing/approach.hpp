// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nc/probing/probing.hpp"

namespace trueaxis::nc {

/// How the probe comes to a surface and leaves it: along one axis, from where it is clear and back.
struct Approach {
  char axis = 'X';
  double sense = -1.0;    ///< +1: the axis counts up towards the part
  double clear_mm = 0.0;  ///< of the axis
  double met_mm = 0.0;    ///< of the axis where the ball's centre is at contact, as planned
  double slope = 0.0;     ///< of that over the other axis

  /// The axis that the pass runs along.
  char along() const { return axis == 'X' ? 'Z' : 'X'; }
  double met_at(double along_mm) const { return met_mm + slope * along_mm; }
};

Approach approach_of(const ProbingPlan& plan, const ProbingPass& pass, const ProbingLimits& limits);

}  // namespace trueaxis::nc
