// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Before any part: lags of the catalogue's typical delays at the speeds of probing and cutting
/// together, and gains up to the largest that a sensor may have.
LoopPrior loop_prior(double probing_rad_per_s, double cutting_rad_per_s);

/// The response by all parts so far, shrunk towards 0 by the prior. Each part counts by its u and
/// by how far cuts of this machine scatter (Eqs. 323, 324).
LoopResponse response_of(const MachineLoop& loop, const LoopPrior& prior);

/// What a verification contradicts; none: it may be learned from.
enum class LoopTrouble {
  none,
  beyond_machines,  ///< no gain and no lag is as large
  wrong_sign,       ///< the error grew where the table should have shrunk it
  changed,          ///< it is off what the parts before tell, beyond their uncertainties
};

LoopTrouble trouble_with(const MachineLoop& before, const LoopResponse& used,
                         const LoopObservation& seen, const LoopPrior& prior);

/// The same with one part more, whose table was made with `used`.
MachineLoop learned(MachineLoop before, const LoopResponse& used, const LoopObservation& seen);

/// How much farther the uncertainty of the response makes that of an axis.
AxisCovariance covariance_of(const LoopResponse& loop, const Axis& axis);

}  // namespace trueaxis
