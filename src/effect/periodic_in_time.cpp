// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "effect/kinds.hpp"
#include "trueaxis/base/units.hpp"

namespace trueaxis::kind {

Linear linear(const PeriodicInTime&, const TermShape&) {
  return {{"amplitude_cos", "mm"}, {"amplitude_sin", "mm"}};
}

Names shapes(const PeriodicInTime&) { return {"frequency_hz"}; }

void fill(const PeriodicInTime&, const TermContext& at, const TermShape& shape, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double angle = two_pi * shape.frequency_hz * at.time_s[i];
    out[0][i] = std::cos(angle);
    out[1][i] = std::sin(angle);
  }
}

}  // namespace trueaxis::kind
