// SPDX-License-Identifier: Apache-2.0
#include "nc/probing/approach.hpp"

namespace trueaxis::nc {

Approach approach_of(const ProbingPlan& plan, const ProbingPass& pass,
                     const ProbingLimits& limits) {
  const double side = pass.rear ? -1.0 : 1.0;
  Approach out;
  switch (plan.surface) {
    case ProbedSurface::shaft:
      out.sense = -side, out.clear_mm = side * limits.clear_x_mm();
      break;
    case ProbedSurface::bore:
      out.sense = side, out.clear_mm = side * limits.inside_x_mm();
      break;
    case ProbedSurface::face:
      out.axis = 'Z', out.sense = -1.0, out.clear_mm = limits.clear_z_mm();
      break;
  }
  out.met_mm = side * plan.size_mm - out.sense * limits.ball_radius_mm;
  out.slope = side * plan.slope;
  return out;
}

}  // namespace trueaxis::nc
