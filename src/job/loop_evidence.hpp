// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "trueaxis/effect.hpp"
#include "trueaxis/machine_loop.hpp"

namespace trueaxis {

/// χ² of the parts about their mean.
inline double chi2_about_mean(const LoopEvidence& e) {
  return e.information > 0.0 ? std::max(0.0, e.squares - e.sum * e.sum / e.information) : 0.0;
}

inline void add(LoopEvidence& e, double value, double u) {
  const double weight = 1.0 / (u * u);
  e.information += weight, e.sum += weight * value, e.squares += weight * value * value;
}

struct Shrunk {
  double value, u;
};

/// The mean of the parts, of which variances are wider by `scatter`, shrunk towards 0 (Eq. 324).
inline Shrunk shrunk(const LoopEvidence& e, double scatter, double u_prior) {
  const double information = e.information / scatter + 1.0 / (u_prior * u_prior);
  return {e.sum / scatter / information, 1.0 / std::sqrt(information)};
}

/// Root mean square of sizes that are log-uniform over their range.
inline double typical(const EffectParameter& size) {
  return std::sqrt((size.high * size.high - size.low * size.low) /
                   (2.0 * std::log(size.high / size.low)));
}

}  // namespace trueaxis
