// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "effect/geometry.hpp"
#include "effect/kinds.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::kind {
namespace {

using Of = Response::Of;

// The trigger path lies along X, into the material, and varies with the direction ψ of the normal
// across the stylus, sin of its angle to X being the size.
void fill_pretravel(const TermContext& at, const TermShape& shape, Columns out) {
  const double out_of = contact::away(at);
  contact::Chunk slope, secant, across, psi;
  contact::dx_dy(at, slope.data());
  contact::secant(at, 1.0, secant.data());
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double ny = -out_of * slope[i], nz = -out_of * at.dx_dz[i];  // times the secant
    across[i] = -out_of * std::sqrt(ny * ny + nz * nz) / secant[i];
    psi[i] = shape.order * std::atan2(ny, nz);
  }
  contact::sin_cos(at, psi.data(), out[2], out[1]);
  for (std::size_t i = 0; i < at.size(); ++i) {
    out[0][i] = -out_of;
    out[1][i] *= across[i];
    out[2][i] *= across[i];
  }
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
  const double side = at.rear ? -1.0 : 1.0;  // behind, the gauge is turned round
  switch (term.of) {
    case Of::gain:
      for (std::size_t i = 0; i < at.size(); ++i) {
        out[0][i] = at.sensed_mm[i] - side * shape.reference_x_mm;
      }
      return;
    case Of::nonlinearity:
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double v = (side * at.sensed_mm[i] - shape.reference_x_mm) / shape.range_mm;
        out[0][i] = side * v * v;
        out[1][i] = side * v * v * v;
      }
      return;
    case Of::cyclic: {
      contact::Chunk angle;
      for (std::size_t i = 0; i < at.size(); ++i) {
        angle[i] = two_pi * at.sensed_mm[i] / shape.period_mm;
      }
      return contact::sin_cos(at, angle.data(), out[1], out[0]);
    }
    case Of::pretravel:
      return fill_pretravel(at, shape, out);
    case Of::lag:
      for (std::size_t i = 0; i < at.size(); ++i) out[0][i] = lag(at, shape.time_constant_s, i);
      return;
  }
}

}  // namespace trueaxis::kind
