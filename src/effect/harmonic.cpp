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

// The factor along Z; 1 is left out. A shift of the axis by δ towards θ = 0 is the form
// δ cos α cos θ along the normal.
void scale_by_envelope(const Harmonic& term, const TermContext& at, const TermShape& shape,
                       Columns out) {
  contact::Chunk factor;
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
      for (std::size_t i = 0; i < at.size(); ++i) factor[i] *= factor[i] * cosine;
      break;
    }
    case Envelope::constant:
    case Envelope::growing:
      return;
  }
  for (double* column : out) {
    for (std::size_t i = 0; i < at.size(); ++i) column[i] *= factor[i];
  }
}

void fill_growing(const Harmonic& term, const TermContext& at, Columns out) {
  contact::Chunk u;
  contact::normalised(term.port, at, u.data());
  for (const std::size_t j : {0u, 1u}) {
    for (std::size_t i = 0; i < at.size(); ++i) out[j + 2][i] = u[i] * out[j][i];
  }
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
  const std::span<const double> angle = angle_of(term.angle, at);
  contact::Chunk turned;
  for (std::size_t i = 0; i < at.size(); ++i) turned[i] = n * angle[i];
  contact::sin_cos(at, turned.data(), out[1], out[0]);
  if (term.envelope == Envelope::jaws) {
    for (std::size_t i = 0; i < at.size(); ++i) turned[i] *= 2.0;
    contact::sin_cos(at, turned.data(), out[3], out[2]);
  }
  const Columns own = term.envelope == Envelope::growing ? out.first(2) : out;
  scale_by_envelope(term, at, shape, own);
  contact::scale_by_dx_d(term.port, at, own);
  if (term.envelope == Envelope::growing) fill_growing(term, at, out);
}

}  // namespace trueaxis::kind
