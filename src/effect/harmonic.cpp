// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "effect/geometry.hpp"
#include "effect/kinds.hpp"

namespace trueaxis::kind {
namespace {

using Angle = Harmonic::Angle;
using Envelope = Harmonic::Envelope;

double order_of(const Harmonic& term, const TermShape& shape) {
  return term.fixed_order > 0.0 ? term.fixed_order : shape.order;
}

double angle_at(Angle angle, const TermContext& at, std::size_t i) {
  switch (angle) {
    case Angle::part:
      return at.theta_rad[i];
    case Angle::chuck:
      return at.theta_chuck_rad[i];
    case Angle::spindle:
      break;
  }
  return at.c_rad[i];
}

// A shift of the axis by δ towards θ = 0 is the form δ cos α cos θ along the normal.
double envelope_at(const Harmonic& term, const TermContext& at, const TermShape& shape,
                   std::size_t i) {
  switch (term.envelope) {
    case Envelope::lever:
      return contact::along_mm(term.port, at, i) - shape.lever_from_mm;
    case Envelope::jaws: {
      const double away = std::abs(at.s_mm[i] - shape.lever_from_mm);
      return at.clamp_force_ratio[i] * std::exp(-away / shape.decay_length_mm);
    }
    case Envelope::parabola: {
      const double u = contact::normalised(term.port, at, i);
      return u * u / std::hypot(1.0, at.tan_half_angle);
    }
    case Envelope::constant:
    case Envelope::growing:
      break;
  }
  return 1.0;
}

}  // namespace

Linear linear(const Harmonic& term, const TermShape&) {
  const std::string unit = term.envelope == Envelope::lever ? "rad" : unit_of(term.port);
  Linear list{{"amplitude_cos", unit}, {"amplitude_sin", unit}};
  if (term.envelope == Envelope::growing) {
    list.insert(list.end(), {{"growth_cos", unit}, {"growth_sin", unit}});
  }
  if (term.envelope == Envelope::jaws) {
    list.insert(list.end(), {{"second_cos", unit}, {"second_sin", unit}});
  }
  return list;
}

Names shapes(const Harmonic& term) {
  Names names;
  if (term.fixed_order == 0.0) names.emplace_back("order");
  if (term.envelope == Envelope::lever) names.emplace_back("lever_from_mm");
  if (term.envelope == Envelope::jaws) {
    names.insert(names.end(), {"lever_from_mm", "decay_length_mm"});
  }
  return names;
}

void fill(const Harmonic& term, const TermContext& at, const TermShape& shape, Columns out) {
  const double n = order_of(term, shape);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double angle = n * angle_at(term.angle, at, i);
    const double size = envelope_at(term, at, shape, i) * contact::dx_d(term.port, at, i);
    out[0][i] = size * std::cos(angle);
    out[1][i] = size * std::sin(angle);
    if (term.envelope == Envelope::growing) {
      const double u = contact::normalised(term.port, at, i);
      out[2][i] = u * out[0][i];
      out[3][i] = u * out[1][i];
    }
    if (term.envelope == Envelope::jaws) {
      out[2][i] = size * std::cos(2.0 * angle);
      out[3][i] = size * std::sin(2.0 * angle);
    }
  }
}

}  // namespace trueaxis::kind
