// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>

#include "effect/kinds.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::kind {
namespace {

using Angle = Harmonic::Angle;
using Envelope = Harmonic::Envelope;

/// The columns of the factors cos, sin of a value that moves `port`.
std::string unit_of(TermPort port) { return port == TermPort::c ? "rad" : "mm"; }

double order_of(const Harmonic& term, const TermShape& shape) {
  return term.fixed_order > 0.0 ? term.fixed_order : shape.order;
}

std::span<const double> angle_of(Angle angle, const TermContext& at) {
  switch (angle) {
    case Angle::part:
      return at.theta_rad;
    case Angle::chuck:
      return at.theta_chuck_rad;
    case Angle::spindle:
      break;
  }
  return at.c_rad;
}

// The mean of u² over the probed length: less it, a bent axis (n = 1) is about the straight line
// nearest to it.
double mean_of_u2(const Harmonic& term, const TermShape& shape) {
  return order_of(term, shape) == 1.0 ? 1.0 / 3.0 : 0.0;
}

// The factor along Z; 1 is not written. A shift of the axis by δ towards θ = 0 is the form
// δ cos α cos θ along the normal.
void scale_by_envelope(const Harmonic& term, const TermContext& at, const TermShape& shape,
                       Columns out) {
  Chunk factor;
  switch (term.envelope) {
    case Envelope::lever: {
      const std::span<const double> along = contact::along_mm(term.port, at);
      for (std::size_t i = 0; i < at.size(); ++i) factor[i] = along[i] - shape.lever_from_mm;
      break;
    }
    case Envelope::jaws:
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double away = std::abs(at.s_mm[i] - shape.lever_from_mm);
        factor[i] = at.clamp_force_ratio[i] * std::exp(-away / shape.decay_length_mm);
      }
      break;
    case Envelope::parabola: {
      contact::normalised(term.port, at, factor.data());
      const double cosine = 1.0 / std::hypot(1.0, at.tan_half_angle);
      const double mean = mean_of_u2(term, shape);
      for (std::size_t i = 0; i < at.size(); ++i)
        factor[i] = (factor[i] * factor[i] - mean) * cosine;
      break;
    }
    case Envelope::square:
      contact::share_of_end(at, factor.data());
      for (std::size_t i = 0; i < at.size(); ++i) factor[i] *= factor[i];
      break;
    case Envelope::constant:
    case Envelope::growing:
      return;
  }
  for (double* column : out) {
    for (std::size_t i = 0; i < at.size(); ++i) column[i] *= factor[i];
  }
}

void fill_growing(const Harmonic& term, const TermContext& at, Columns out) {
  Chunk u;
  contact::normalised(term.port, at, u.data());
  for (const std::size_t j : {0u, 1u}) {
    for (std::size_t i = 0; i < at.size(); ++i) out[j + 2][i] = u[i] * out[j][i];
  }
}

int last_degree(const PolynomialInZ& term, const TermShape& shape) {
  return term.last > 0 ? term.last : shape.degree;
}

}  // namespace

Parameters parameters(const Harmonic& term, const TermShape&) {
  const std::string unit = term.envelope == Envelope::lever ? "rad" : unit_of(term.port);
  Parameters out = amplitude_pair(unit);
  if (term.fixed_order == 0.0) out.shape.emplace_back("order");
  if (term.envelope == Envelope::lever) out.shape.emplace_back("lever_from_mm");
  if (term.envelope == Envelope::growing) add_pair("growth", unit, out.linear);
  if (term.envelope == Envelope::lever)
    add_pair(term.port == TermPort::z ? "axial" : "radial", "mm", out.linear);
  if (term.envelope == Envelope::jaws) {
    add_pair("second", unit, out.linear);
    out.shape.insert(out.shape.end(), {"lever_from_mm", "decay_length_mm"});
  }
  return out;
}

std::size_t count(const Harmonic& term, const TermShape&) {
  const bool two = term.envelope == Envelope::growing || term.envelope == Envelope::lever ||
                   term.envelope == Envelope::jaws;
  return two ? 4 : 2;
}

void fill(const Harmonic& term, const TermContext& at, const TermShape& shape, Columns out) {
  const double n = order_of(term, shape);
  const std::span<const double> angle = angle_of(term.angle, at);
  Chunk turned;
  for (std::size_t i = 0; i < at.size(); ++i) turned[i] = n * angle[i];
  contact::sin_cos(at, turned.data(), out[1], out[0]);
  if (term.envelope == Envelope::jaws) {
    for (std::size_t i = 0; i < at.size(); ++i) turned[i] *= 2.0;
    contact::sin_cos(at, turned.data(), out[3], out[2]);
  }
  if (term.envelope == Envelope::lever)
    for (const std::size_t j : {0u, 1u}) std::copy_n(out[j], at.size(), out[j + 2]);
  const bool two_envelopes = term.envelope == Envelope::growing || term.envelope == Envelope::lever;
  scale_by_envelope(term, at, shape, two_envelopes ? out.first(2) : out);
  contact::scale_by_dx_d(term.port, at, term.envelope == Envelope::growing ? out.first(2) : out);
  if (term.envelope == Envelope::growing) fill_growing(term, at, out);
}

Parameters parameters(const PolynomialInZ& term, const TermShape& shape) {
  Parameters out;
  if (term.last == 0) out.shape.emplace_back("degree");
  if (term.plain) {
    out.linear = {{"slope", "rad"}};
    return out;
  }
  if (term.dish) out.linear.push_back({"dish", unit_of(term.port)});
  for (int l = term.first; l <= last_degree(term, shape); ++l)
    out.linear.push_back({"amplitude_" + std::to_string(l), unit_of(term.port), "amplitude"});
  return out;
}

std::size_t count(const PolynomialInZ& term, const TermShape& shape) {
  if (term.plain) return 1;
  const int degrees = std::max(0, last_degree(term, shape) - term.first + 1);
  return static_cast<std::size_t>(degrees) + (term.dish ? 1 : 0);
}

// Bonnet's recursion, which also holds a little outside [−1, 1], where a probe may overrun.
void fill(const PolynomialInZ& term, const TermContext& at, const TermShape& shape, Columns out) {
  const std::size_t size = at.size();
  if (term.plain) {
    const std::span<const double> along = contact::along_mm(term.port, at);
    const double from_mm = at.face ? at.z_mid_mm : 0.0;  // the height of a face stays its mean
    for (std::size_t i = 0; i < size; ++i) out[0][i] = along[i] - from_mm;
    return contact::scale_by_dx_d(term.port, at, out);
  }
  const int last = last_degree(term, shape);
  const Columns degrees = out.subspan(term.dish ? 1 : 0);
  Chunk u, before, now;
  if (term.dish) {
    contact::share_of_end(at, u.data());
    const double end_mm = std::abs(at.z_mid_mm) + at.z_half_mm;
    const double mean =
        (at.z_mid_mm * at.z_mid_mm + at.z_half_mm * at.z_half_mm / 3.0) / end_mm / end_mm;
    for (std::size_t i = 0; i < size; ++i) out[0][i] = u[i] * u[i] - mean;
  }
  contact::normalised(term.port, at, u.data());
  std::fill_n(before.begin(), size, 1.0);
  std::copy_n(u.begin(), size, now.begin());
  for (int l = 1; l <= last; ++l) {
    if (l >= term.first) {
      std::copy_n(now.begin(), size, degrees[static_cast<std::size_t>(l - term.first)]);
    }
    for (std::size_t i = 0; i < size; ++i) {
      before[i] = boost::math::legendre_next(static_cast<unsigned>(l), u[i], now[i], before[i]);
    }
    std::swap(before, now);
  }
  contact::scale_by_dx_d(term.port, at, out);
}

Parameters parameters(const PeriodicInZ& term, const TermShape&) {
  return amplitude_pair(unit_of(term.port), {"period_mm"});
}

void fill(const PeriodicInZ& term, const TermContext& at, const TermShape& shape, Columns out) {
  const double k = two_pi / shape.period_mm;
  const std::span<const double> along = contact::along_mm(term.port, at);
  Chunk angle;
  for (std::size_t i = 0; i < at.size(); ++i) {
    angle[i] = k * along[i] - term.turns * at.theta_rad[i];
  }
  contact::sin_cos(at, angle.data(), out[1], out[0]);
  contact::scale_by_dx_d(term.port, at, out);
}

Parameters parameters(const FormAtEnds&, const TermShape&) {
  return {{{"low", "mm"}, {"high", "mm"}}, {"decay_length_mm"}};
}

void fill(const FormAtEnds&, const TermContext& at, const TermShape& shape, Columns out) {
  Chunk u;
  contact::normalised(TermPort::normal, at, u.data());
  const double lengths = at.z_half_mm / shape.decay_length_mm;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double low = (u[i] + 1.0) * lengths, high = (u[i] - 1.0) * lengths;
    out[0][i] = std::exp(-0.5 * low * low);
    out[1][i] = std::exp(-0.5 * high * high);
  }
  contact::scale_by_dx_d(TermPort::normal, at, out);
}

Parameters parameters(const PeriodicInTime&, const TermShape&) {
  return amplitude_pair("mm", {"frequency_hz"});
}

void fill(const PeriodicInTime&, const TermContext& at, const TermShape& shape, Columns out) {
  const double turning_rad_per_s = two_pi * shape.frequency_hz;
  Chunk angle;
  for (std::size_t i = 0; i < at.size(); ++i) angle[i] = turning_rad_per_s * at.time_s[i];
  contact::sin_cos(at, angle.data(), out[1], out[0]);
}

Parameters parameters(const GrowthInTime&, const TermShape&) {
  return {{{"rate", "mm/s"}, {"amplitude", "mm"}}, {"time_constant_s"}};
}

void fill(const GrowthInTime&, const TermContext& at, const TermShape& shape, Columns out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    out[0][i] = at.time_s[i];
    out[1][i] = -std::expm1(-at.time_s[i] / shape.time_constant_s);
  }
}

}  // namespace trueaxis::kind
