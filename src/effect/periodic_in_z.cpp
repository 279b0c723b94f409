// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "effect/geometry.hpp"
#include "effect/kinds.hpp"
#include "trueaxis/base/units.hpp"

namespace trueaxis::kind {

Linear linear(const PeriodicInZ& term, const TermShape&) {
  return {{"amplitude_cos", unit_of(term.port)}, {"amplitude_sin", unit_of(term.port)}};
}

Names shapes(const PeriodicInZ&) { return {"period_mm"}; }

void fill(const PeriodicInZ& term, const TermContext& at, const TermShape& shape, Columns out) {
  const double k = two_pi / shape.period_mm;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double angle = k * contact::along_mm(term.port, at, i) - term.turns * at.theta_rad[i];
    const double size = contact::dx_d(term.port, at, i);
    out[0][i] = size * std::cos(angle);
    out[1][i] = size * std::sin(angle);
  }
}

}  // namespace trueaxis::kind
