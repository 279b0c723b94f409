// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "effect/geometry.hpp"
#include "effect/kinds.hpp"
#include "trueaxis/base/units.hpp"

namespace trueaxis::kind {
namespace {

using Of = Response::Of;

// The trigger path lies along X, into the material, and varies with the direction ψ of the normal
// across the stylus, sin of its angle to X being the size.
void pretravel(const TermContext& at, const TermShape& shape, std::size_t i, Columns out) {
  const double out_of = contact::away(at), secant = contact::secant(at, i);
  const double ny = -out_of * contact::dx_dy(at, i) / secant;
  const double nz = -out_of * at.dx_dz[i] / secant;
  const double across = std::hypot(ny, nz), psi = shape.order * std::atan2(ny, nz);
  out[0][i] = -out_of;
  out[1][i] = -out_of * across * std::cos(psi);
  out[2][i] = -out_of * across * std::sin(psi);
}

// d/dT of the indication at T. Turning, X is nearly one harmonic of C and H = 1/(1 + jωT) exactly
// turns it into X + (−T Ẋ + T² Ẍ)/(1 + ω²T²); along Z the slow motion lags by T.
double lag(const TermContext& at, double T, std::size_t i) {
  const double w = at.speed_rad_per_s[i];
  const double rate = w * at.dx_dc[i], rate2 = w * w * at.d2x_dc2[i];
  const double q = 1.0 + w * w * T * T;
  const double turning =
      ((-rate + 2.0 * T * rate2) * q - (-T * rate + T * T * rate2) * 2.0 * w * w * T) / (q * q);
  return turning - at.velocity_mm_per_s[i] * at.dx_dz[i];
}

}  // namespace

Linear linear(const Response& term, const TermShape&) {
  switch (term.of) {
    case Of::nonlinearity:
      return {{"quadratic", "mm"}, {"cubic", "mm"}};
    case Of::cyclic:
      return {{"amplitude_cos", "mm"}, {"amplitude_sin", "mm"}};
    case Of::pretravel:
      return {{"amplitude", "mm"}, {"lobing_cos", "mm"}, {"lobing_sin", "mm"}};
    case Of::lag:
      return {{"time_constant", "s"}};
    case Of::gain:
      break;
  }
  return {{"gain", "1"}};
}

Names shapes(const Response& term) {
  switch (term.of) {
    case Of::nonlinearity:
      return {"reference_x_mm", "range_mm"};
    case Of::cyclic:
      return {"period_mm"};
    case Of::pretravel:
      return {"order"};
    case Of::lag:
      return {"time_constant_s"};
    case Of::gain:
      break;
  }
  return {"reference_x_mm"};
}

void fill(const Response& term, const TermContext& at, const TermShape& shape, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double away = at.sensed_mm[i] - shape.reference_x_mm;
    switch (term.of) {
      case Of::gain:
        out[0][i] = away;
        break;
      case Of::nonlinearity: {
        const double v = away / shape.range_mm;
        out[0][i] = v * v;
        out[1][i] = v * v * v;
        break;
      }
      case Of::cyclic: {
        const double angle = two_pi * at.sensed_mm[i] / shape.period_mm;
        out[0][i] = std::cos(angle);
        out[1][i] = std::sin(angle);
        break;
      }
      case Of::pretravel:
        pretravel(at, shape, i, out);
        break;
      case Of::lag:
        out[0][i] = lag(at, shape.time_constant_s, i);
        break;
    }
  }
}

}  // namespace trueaxis::kind
