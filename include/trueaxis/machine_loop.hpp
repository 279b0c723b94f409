// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueaxis/correction.hpp"

namespace trueaxis {

/// What parts that were probed again after the cut told of one number of the machine: sums of
/// 1/u², value/u² and value²/u² over the parts.
struct LoopEvidence {
  double information = 0.0, sum = 0.0, squares = 0.0;
};

/// The same of an order of the motion of the spindle.
struct MotionEvidence {
  int order = 0;
  LoopEvidence cos{}, sin{};
};

/// The error that stays: the axis of a cut, probed again, over the target axis (logarithm), beyond
/// what the table was corrected for. Standard uncertainties are those of the readings, and of what
/// the cut shows that is neither gain nor lag.
struct LoopObservation {
  double gain = 0.0, lag_rad = 0.0, u_gain = 0.0, u_lag_rad = 0.0;
  double per_mm = 0.0;  ///< standard deviation of either if cuts scatter by 1 mm in x and in y
  std::vector<LearnedMotion> motion{};  ///< less the form that was left; none: not measured
};

/// What is known of the machine from the parts before. Each part adds the whole response: what its
/// table was corrected for, and what its verification shows beyond that.
struct MachineLoop {
  std::vector<LoopObservation> parts{};  ///< without their motions
  int forms = 0;                         ///< parts whose form was measured elsewhere
  std::vector<MotionEvidence> motion{};
};

/// The response before any part was verified: normal about 0.
struct LoopPrior {
  double u_gain = 0.0, u_lag_rad = 0.0;
};

/// What a job hands on to that of the next part.
struct MachineFeedback {
  std::string machine{};                 ///< JSON: what must be the same for the next part
  std::vector<std::string> corrected{};  ///< ids of causes in the probe that the axes are without
  std::vector<std::string> streams{};    ///< hashes of all readings so far, this part's last
  LoopPrior prior{};
  MachineLoop before{}, after{};          ///< without and with this part's verification
  std::optional<LoopObservation> seen{};  ///< at this part; none: not probed again
  double off_mm = 0.0, U_off_mm = 0.0;    ///< the cut from the target axis, as probed
};

}  // namespace trueaxis
