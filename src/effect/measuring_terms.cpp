// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "effect/kinds.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::kind {
namespace {

using By = ArgumentShift::By;

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

using Of = Response::Of;

constexpr double pi = 0.5 * two_pi;

// The trigger path lies along X, into the material. It varies with the direction ψ of the normal
// across the stylus; the size is the sine of its angle to X (Eq. 51).
void fill_pretravel(const TermContext& at, const TermShape& shape, Columns out) {
  const double out_of = contact::away(at);
  Chunk slope, secant, across, psi;
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

/// The share of a slip that the part has not moved by then, as what is missing of it (Eq. 46).
double missing_of(const TermShape& shape, double time_s) {
  const double since = time_s - shape.onset_s;
  if (since >= shape.duration_s) return 0.0;
  if (since < 0.0) return -1.0;
  const double left = shape.duration_s - since, tau = shape.settling_s;
  if (!(tau > 0.0)) return -left / shape.duration_s;
  return std::exp(-since / tau) * std::expm1(-left / tau) / -std::expm1(-shape.duration_s / tau);
}

// A face whose axis tilts towards x falls there: Z = c − slope · (x, y).
void fill_seat(const TermContext& at, const TermShape& shape, const contact::Chunk& sine,
               const contact::Chunk& cosine, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double missing = missing_of(shape, at.time_s[i]);
    out[0][i] = missing;
    out[1][i] = -missing * at.z_mm[i] * cosine[i];
    out[2][i] = -missing * at.z_mm[i] * sine[i];
  }
}

// d/dT of the indication at T. Turning, X is nearly one harmonic of C and H = 1/(1 + jωT) exactly
// turns it into X + (−T Ẋ + T² Ẍ)/(1 + ω²T²); along Z the slow motion lags by T (Eqs. 52, 53).
double lag(const TermContext& at, double T, std::size_t i) {
  const double w = at.speed_rad_per_s[i];
  const double rate = w * at.dx_dc[i], rate2 = w * w * at.d2x_dc2[i];
  const double q = 1.0 + w * w * T * T;
  const double turning =
      ((-rate + 2.0 * T * rate2) * q - (-T * rate + T * T * rate2) * 2.0 * w * w * T) / (q * q);
  return turning - at.velocity_mm_per_s[i] * at.dx_dz[i];
}

struct Swing {
  double mm, ahead_rad;  ///< ahead of what is read
};

// X as a play b leaves a harmonic of `read_mm` of it, by Newton's method on k = b/2E (Eq. 53b).
Swing swing_behind_play(double read_mm, double play_mm) {
  constexpr int rounds = 5;
  const double share = 2.0 * read_mm / play_mm;  // |N(k)| = share · k
  double k = std::min(0.9, 1.0 / share);
  double real = 1.0, imaginary = 0.0;
  for (int round = 0; round <= rounds; ++round) {
    const double c = 1.0 - 2.0 * k, root = std::sqrt(std::max(0.0, 1.0 - c * c));
    real = (0.5 * pi + std::asin(c) + c * root) / pi, imaginary = (1.0 - c * c) / pi;
    if (round == rounds) break;
    const double size = std::hypot(real, imaginary);
    const double slope = -4.0 * (real * root - imaginary * c) / (pi * size) - share;
    k = std::clamp(k - (size - share * k) / slope, 1e-9, 0.999);
  }
  return {0.5 * play_mm / k, std::atan2(imaginary, real)};
}

// Reversed, X goes back by the play b before the reading follows; until then the reading does not
// change. X is nearly E cos ψ + p ψ, ψ running with the spindle and p what the feed adds: it grows
// from ψ = −π − a to a and falls from a to π − a, sin a = p/E (Eq. 53a).
double hysteresis(const TermContext& at, double play_mm, std::size_t i) {
  if (!at.play_side.empty()) return -0.5 * at.play_side[i];
  const double turning = std::abs(at.speed_rad_per_s[i]);
  const double advancing = at.velocity_mm_per_s[i] * at.dx_dz[i];
  double swing = std::hypot(at.dx_dc[i], at.d2x_dc2[i]);
  if (turning * swing <= std::abs(advancing)) return -0.5 * sign(advancing);
  double psi = std::atan2(-sign(at.speed_rad_per_s[i]) * at.dx_dc[i], -at.d2x_dc2[i]);
  if (at.as_read && play_mm > 0.0) {
    const Swing moved = swing_behind_play(swing, play_mm);
    swing = moved.mm, psi += moved.ahead_rad;
  }
  const double per_rad = advancing / turning, extreme = std::asin(per_rad / swing);
  if (psi >= pi - extreme) psi -= two_pi;
  if (psi < -pi - extreme) psi += two_pi;
  const bool grows = psi < extreme, outward = per_rad >= 0.0;
  if (play_mm <= 0.0) return grows ? -0.5 : 0.5;
  const auto x_mm = [&](double angle) { return swing * std::cos(angle) + per_rad * angle; };
  const double low = x_mm(-pi - extreme), high = x_mm(extreme), end = x_mm(pi - extreme);
  const double flat = std::min({play_mm, high - low, high - end});
  const double back = std::clamp(grows ? x_mm(psi) - low : high - x_mm(psi), 0.0, flat);
  // In the direction of the feed all of the play counts, the other way what there is of it.
  const double taken_up = grows == outward ? flat - back : back;
  return (outward ? -1.0 : 1.0) * (0.5 - taken_up / play_mm);
}

}  // namespace

Parameters parameters(const ArgumentShift& term, const TermShape&) {
  switch (term.by) {
    case By::delay:
      return {{{"delay", "s"}}};
    case By::backlash:
      return {{{"along", "mm"}, {"across", "mm"}}};
    case By::angle:
      break;
  }
  return {{{"angle", "rad"}}};
}

std::size_t count(const ArgumentShift& term, const TermShape&) {
  return term.by == By::backlash ? 2 : 1;
}

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

Parameters parameters(const ProbeLine& term, const TermShape&) {
  switch (term.of) {
    case ProbeLine::Of::tilt:
      return {{{"tilt", "rad"}}};
    case ProbeLine::Of::ball:
      return {{{"radius", "mm"}}};
    case ProbeLine::Of::height:
      break;
  }
  return {{{"height", "mm"}}};
}

// Tilt: the contact's height on the line is Z + X sin γ; of a face its X is X − Z sin γ. Ball: its
// centre is off along the normal, out of the material.
void fill(const ProbeLine& term, const TermContext& at, const TermShape&, Columns out) {
  switch (term.of) {
    case ProbeLine::Of::height:
      return contact::dx_dy(at, out[0]);
    case ProbeLine::Of::tilt:
      for (std::size_t i = 0; i < at.size(); ++i)
        out[0][i] = (at.face ? -at.x_mm[i] : at.x_mm[i]) * at.dx_dz[i];
      return;
    case ProbeLine::Of::ball:
      return contact::secant(at, contact::away(at), out[0]);
  }
}

Parameters parameters(const Response& term, const TermShape&) {
  switch (term.of) {
    case Of::nonlinearity:
      return {{{"quadratic", "mm"}, {"cubic", "mm"}}, {"reference_x_mm", "range_mm"}};
    case Of::cyclic:
      return amplitude_pair("mm", {"period_mm"});
    case Of::pretravel: {
      Parameters out{{{"amplitude", "mm"}}, {"order"}};
      add_pair("lobing", "mm", out.linear);
      return out;
    }
    case Of::lag:
      return {{{"time_constant", "s"}}, {"time_constant_s"}};
    case Of::hysteresis:
      return {{{"play", "mm"}}, {"play_mm"}};
    case Of::zero:
      return {{{"offset", "mm"}}, {}};
    case Of::gain:
      break;
  }
  return {{{"gain", "1"}}, {"reference_x_mm"}};
}

std::size_t count(const Response& term, const TermShape&) {
  switch (term.of) {
    case Of::nonlinearity:
    case Of::cyclic:
      return 2;
    case Of::pretravel:
      return 3;
    case Of::gain:
    case Of::zero:
    case Of::lag:
    case Of::hysteresis:
      break;
  }
  return 1;
}

void fill(const Response& term, const TermContext& at, const TermShape& shape, Columns out) {
  const double side = at.rear ? -1.0 : 1.0;  // at the rear, the gauge is turned round
  switch (term.of) {
    case Of::gain:
      for (std::size_t i = 0; i < at.size(); ++i) {
        out[0][i] = at.sensed_mm[i] - side * shape.reference_x_mm;
      }
      return;
    case Of::zero:
      std::fill_n(out[0], at.size(), 1.0);
      return;
    case Of::nonlinearity:
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double v = (side * at.sensed_mm[i] - shape.reference_x_mm) / shape.range_mm;
        out[0][i] = side * v * v;
        out[1][i] = side * v * v * v;
      }
      return;
    case Of::cyclic: {
      Chunk angle;
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
    case Of::hysteresis:
      for (std::size_t i = 0; i < at.size(); ++i) out[0][i] = hysteresis(at, shape.play_mm, i);
      return;
  }
}

Parameters parameters(const PartStep& term, const TermShape&) {
  if (term.seat)
    return {{{"dz", "mm"}, {"tilt_x", "rad"}, {"tilt_y", "rad"}},
            {"onset_s", "duration_s", "settling_s"}};
  return {{{"dx", "mm"},
           {"dy", "mm"},
           {"turn", "rad"},
           {"tilt_x", "rad"},
           {"tilt_y", "rad"},
           {"dr", "mm"},
           {"taper", "rad"}},
          {"onset_s", "duration_s", "settling_s"}};
}

// A part that moved along x and y of the spindle frame is met at X = f(Y − b, Z) + a with a, b the
// motion along machine X and Y; one that slipped by `turn` in the sense of C, at C − turn. A tilt
// about the middle of what was probed moves it by its lever there, and along Z by −X times the tilt
// towards the probe. The surface is where the part is after it: before it, all of that is missing,
// and while it lasts, a share. Eq. 46.
void fill(const PartStep& term, const TermContext& at, const TermShape& shape, Columns out) {
  Chunk sine, cosine, slope;
  contact::sin_cos(at, at.c_rad.data(), sine.data(), cosine.data());
  if (term.seat) return fill_seat(at, shape, sine, cosine, out);
  contact::dx_dy(at, slope.data());
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double missing = missing_of(shape, at.time_s[i]);
    const double along_x = cosine[i] + sine[i] * slope[i];
    const double along_y = sine[i] - cosine[i] * slope[i];
    const double lever = at.z_mm[i] - at.z_mid_mm, along_z = at.dx_dz[i] * at.x_mm[i];
    out[0][i] = missing * along_x;
    out[1][i] = missing * along_y;
    out[2][i] = -missing * at.dx_dc[i];
    out[3][i] = missing * (lever * along_x + along_z * cosine[i]);
    out[4][i] = missing * (lever * along_y + along_z * sine[i]);
    out[5][i] = missing;
    out[6][i] = missing * lever;
  }
}

}  // namespace trueaxis::kind
