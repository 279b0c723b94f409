// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "effect/kinds.hpp"

namespace trueaxis::kind {

Linear linear(const GrowthInTime&, const TermShape&) {
  return {{"rate", "mm/s"}, {"amplitude", "mm"}};
}

Names shapes(const GrowthInTime&) { return {"time_constant_s"}; }

void fill(const GrowthInTime&, const TermContext& at, const TermShape& shape, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    out[0][i] = at.time_s[i];
    out[1][i] = -std::expm1(-at.time_s[i] / shape.time_constant_s);
  }
}

}  // namespace trueaxis::kind
