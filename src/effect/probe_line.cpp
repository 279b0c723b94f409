// SPDX-License-Identifier: Apache-2.0
#include "effect/geometry.hpp"
#include "effect/kinds.hpp"

namespace trueaxis::kind {

Linear linear(const ProbeLine& term, const TermShape&) {
  switch (term.of) {
    case ProbeLine::Of::tilt:
      return {{"tilt", "rad"}};
    case ProbeLine::Of::ball:
      return {{"radius", "mm"}};
    case ProbeLine::Of::height:
      break;
  }
  return {{"height", "mm"}};
}

Names shapes(const ProbeLine&) { return {}; }

// Tilt: the contact's height on the line is Z + X sin γ. Ball: its centre stands off along the
// normal, out of the material.
void fill(const ProbeLine& term, const TermContext& at, const TermShape&, Columns out) {
  switch (term.of) {
    case ProbeLine::Of::height:
      return contact::dx_dy(at, out[0]);
    case ProbeLine::Of::tilt:
      for (std::size_t i = 0; i < at.size(); ++i) out[0][i] = at.x_mm[i] * at.dx_dz[i];
      return;
    case ProbeLine::Of::ball:
      return contact::secant(at, contact::away(at), out[0]);
  }
}

}  // namespace trueaxis::kind
