// SPDX-License-Identifier: Apache-2.0
#include "effect/geometry.hpp"
#include "effect/kinds.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::kind {

Linear linear(const PeriodicInTime&, const TermShape&) {
  return {{"amplitude_cos", "mm"}, {"amplitude_sin", "mm"}};
}

Names shapes(const PeriodicInTime&) { return {"frequency_hz"}; }

void fill(const PeriodicInTime&, const TermContext& at, const TermShape& shape, Columns out) {
  const double turning_rad_per_s = two_pi * shape.frequency_hz;
  contact::Chunk angle;
  for (std::size_t i = 0; i < at.size(); ++i) angle[i] = turning_rad_per_s * at.time_s[i];
  contact::sin_cos(at, angle.data(), out[1], out[0]);
}

}  // namespace trueaxis::kind
