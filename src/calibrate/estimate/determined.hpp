// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace trueaxis::calibrate_detail {

/// An unknown that is held, and those that move the readings as it does.
struct Held {
  std::size_t unknown = 0;
  std::vector<std::size_t> alike;
  bool places = false;  ///< the ball's centre, or the bar's line, is one of them
  double effect = 0.0;  ///< of its largest plausible size, in σ of all readings together
  double left = 0.0;    ///< of it once the rest is fitted
};

struct Determined {
  std::vector<std::size_t> kept;  ///< ascending
  std::vector<Held> held;
};

/// Which unknowns a measurement determines (Eqs. 174, 175). `unknowns` are columns over σ, each
/// times its largest plausible size, the preferred ones first; `places` those that are always
/// fitted, over σ. An unknown is held if less than one σ of it is left after the places and the
/// unknowns before it. Then, while some direction of the others stays below one σ, the last unknown
/// that takes part in it is held. The threshold is absolute. Ball data tell 13 to 19 of 30
/// unknowns, and the rest come back in second order off the nominal ball. A relative threshold
/// would let them swallow whole effects there. @param tells the threshold, σ
Determined determine(const Eigen::MatrixXd& unknowns, const Eigen::MatrixXd& places,
                     double tells = 1.0);

}  // namespace trueaxis::calibrate_detail
