// SPDX-License-Identifier: Apache-2.0
#include "effect/kinds.hpp"

namespace trueaxis::kind {
namespace {

using By = ArgumentShift::By;

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

}  // namespace

Linear linear(const ArgumentShift& term, const TermShape&) {
  switch (term.by) {
    case By::delay:
      return {{"delay", "s"}};
    case By::backlash:
      return {{"along", "mm"}, {"across", "mm"}};
    case By::angle:
      break;
  }
  return {{"angle", "rad"}};
}

Names shapes(const ArgumentShift&) { return {}; }

void fill(const ArgumentShift& term, const TermContext& at, const TermShape&, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    switch (term.by) {
      case By::angle:
        out[0][i] = at.dx_dc[i];
        break;
      case By::delay:
        out[0][i] = -at.speed_rad_per_s[i] * at.dx_dc[i] - at.velocity_mm_per_s[i] * at.dx_dz[i];
        break;
      case By::backlash: {
        const double half = 0.5 * sign(at.velocity_mm_per_s[i]);
        out[0][i] = -half * at.dx_dz[i];
        out[1][i] = half;
        break;
      }
    }
  }
}

}  // namespace trueaxis::kind
