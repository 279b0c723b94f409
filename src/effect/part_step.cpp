// SPDX-License-Identifier: Apache-2.0
#include "effect/geometry.hpp"
#include "effect/kinds.hpp"

namespace trueaxis::kind {

Linear linear(const PartStep&, const TermShape&) {
  return {{"dx", "mm"}, {"dy", "mm"}, {"turn", "rad"}};
}

Names shapes(const PartStep&) { return {"onset_s"}; }

// A part that slipped by `turn` in the sense of C is met at C − turn.
void fill(const PartStep&, const TermContext& at, const TermShape& shape, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const bool after = at.time_s[i] >= shape.onset_s;
    out[0][i] = after ? contact::dx_dpart_x(at, i) : 0.0;
    out[1][i] = after ? contact::dx_dpart_y(at, i) : 0.0;
    out[2][i] = after ? -at.dx_dc[i] : 0.0;
  }
}

}  // namespace trueaxis::kind
