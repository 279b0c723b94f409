// SPDX-License-Identifier: Apache-2.0
#include "effect/geometry.hpp"
#include "effect/kinds.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::kind {

Linear linear(const PeriodicInZ& term, const TermShape&) {
  return {{"amplitude_cos", unit_of(term.port)}, {"amplitude_sin", unit_of(term.port)}};
}

Names shapes(const PeriodicInZ&) { return {"period_mm"}; }

void fill(const PeriodicInZ& term, const TermContext& at, const TermShape& shape, Columns out) {
  const double k = two_pi / shape.period_mm;
  const std::span<const double> along = contact::along_mm(term.port, at);
  contact::Chunk angle;
  for (std::size_t i = 0; i < at.size(); ++i) {
    angle[i] = k * along[i] - term.turns * at.theta_rad[i];
  }
  contact::sin_cos(at, angle.data(), out[1], out[0]);
  contact::scale_by_dx_d(term.port, at, out);
}

}  // namespace trueaxis::kind
