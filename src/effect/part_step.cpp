// SPDX-License-Identifier: Apache-2.0
#include "effect/geometry.hpp"
#include "effect/kinds.hpp"

namespace trueaxis::kind {

Linear linear(const PartStep&, const TermShape&) {
  return {{"dx", "mm"}, {"dy", "mm"}, {"turn", "rad"}};
}

Names shapes(const PartStep&) { return {"onset_s"}; }

// A part that moved along x and y of the spindle frame is met at X = f(Y − b, Z) + a with a, b the
// motion along machine X and Y; one that slipped by `turn` in the sense of C, at C − turn.
void fill(const PartStep&, const TermContext& at, const TermShape& shape, Columns out) {
  contact::Chunk sine, cosine, slope;
  contact::sin_cos(at, at.c_rad.data(), sine.data(), cosine.data());
  contact::dx_dy(at, slope.data());
  for (std::size_t i = 0; i < at.size(); ++i) {
    const bool after = at.time_s[i] >= shape.onset_s;
    out[0][i] = after ? cosine[i] + sine[i] * slope[i] : 0.0;
    out[1][i] = after ? sine[i] - cosine[i] * slope[i] : 0.0;
    out[2][i] = after ? -at.dx_dc[i] : 0.0;
  }
}

}  // namespace trueaxis::kind
