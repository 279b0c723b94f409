// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

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
  switch (term.by) {
    case By::angle:
      std::copy(at.dx_dc.begin(), at.dx_dc.end(), out[0]);
      break;
    case By::delay:
      for (std::size_t i = 0; i < at.size(); ++i) {
        out[0][i] = -at.speed_rad_per_s[i] * at.dx_dc[i] - at.velocity_mm_per_s[i] * at.dx_dz[i];
      }
      break;
    case By::backlash:
      for (std::size_t i = 0; i < at.size(); ++i) {
        out[1][i] = 0.5 * sign(at.velocity_mm_per_s[i]);
        out[0][i] = -out[1][i] * at.dx_dz[i];
      }
      break;
  }
}

}  // namespace trueaxis::kind
