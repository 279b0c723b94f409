// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/hypothesis.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/threads.hpp"
#include "effect/linear_count.hpp"
#include "math/exponential.hpp"
#include "math/sincos.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t most_parameters = 8;
constexpr std::size_t chunk = 512, part_rows = 64 * chunk;  // of a thread

/// An angle of few turns in −π … π.
double wrapped(double angle_rad) {
  while (angle_rad > std::numbers::pi) angle_rad -= two_pi;
  while (angle_rad < -std::numbers::pi) angle_rad += two_pi;
  return angle_rad;
}

/// Columns of numbers of some readings, not yet set.
std::unique_ptr<double[]> room_for(std::size_t count) {
  return std::make_unique_for_overwrite<double[]>(count);
}

/// The polynomial of a degree at every u, by Bonnet's recursion, which also holds a little outside
/// [−1, 1], where a probe may overrun.
/// @param room of two columns, in one of which the values then are
std::span<const double> legendre(int degree, std::span<const double> u, double* room) {
  const std::size_t count = u.size();
  double *now = room, *before = room + count;
  std::fill_n(now, count, 1.0);
  if (degree > 0) std::ranges::copy(u, now), std::fill_n(before, count, 1.0);
  for (int l = 1; l < degree; ++l) {
    for (std::size_t k = 0; k < count; ++k)
      before[k] = boost::math::legendre_next(static_cast<unsigned>(l), u[k], now[k], before[k]);
    std::swap(now, before);
  }
  return {now, count};
}

void fill_bump(const Pattern& of, const LinearisationPoint& point, const PointPart& at,
               double* column) {
  const bool along = point.has_position && of.length_mm > 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double v = wrapped(at.theta[k] - of.angle_rad) / of.width_rad;
    const double w = along ? (at.s[k] - of.position_mm) / of.length_mm : 0.0;
    column[k] = -0.5 * (v * v + w * w);
  }
  exponential({column, at.size()}, {column, at.size()});
  for (std::size_t k = 0; k < at.size(); ++k) column[k] *= of.spindle ? 1.0 : at.dx_dnormal[k];
}

void fill_pattern(const Pattern& of, const LinearisationPoint& point, const PointPart& at,
                  std::span<double* const> columns) {
  if (of.kind == Pattern::Kind::bump) return fill_bump(of, point, at, columns[0]);
  const std::size_t count = at.size();
  const std::unique_ptr<double[]> room = room_for(6 * count);
  const auto column = [&](std::size_t k) { return std::span(room.get() + k * count, count); };
  const std::span<double> angle = column(0), sine = column(1), cosine = column(2);
  for (std::size_t k = 0; k < count; ++k) {
    angle[k] = of.order * (of.spindle ? at.c[k] : at.theta[k]);
    if (of.kind == Pattern::Kind::line)
      angle[k] -= two_pi * of.frequency * (of.in_time ? at.time[k] : at.s[k]);
  }
  sincos(angle, sine, cosine);
  std::span<const double> envelope;
  if (of.kind == Pattern::Kind::fourier_legendre) {
    const double first = point.time.front(), lasted = point.time.back() - first;
    const std::span<double> u = column(3);
    for (std::size_t k = 0; k < count; ++k)
      u[k] = !of.in_time    ? (at.s[k] - point.z_mid_mm) / point.z_half_mm
             : lasted > 0.0 ? 2.0 * (at.time[k] - first) / lasted - 1.0
                            : 0.0;
    envelope = legendre(of.degree, u, column(4).data());
  }
  for (std::size_t k = 0; k < count; ++k) {
    double size = of.spindle ? 1.0 : at.dx_dnormal[k];
    if (!envelope.empty()) size *= envelope[k];
    columns[0][k] = size * cosine[k];
    if (columns.size() > 1) columns[1][k] = size * sine[k];
  }
}

}  // namespace

void raise_degree(const Hypothesis& function, const LinearisationPoint& point, const PointPart& at,
                  std::span<const double* const> constant, std::span<double* const> columns) {
  const std::unique_ptr<double[]> room = room_for(3 * at.size());
  const std::span<double> u(room.get(), at.size());
  for (std::size_t k = 0; k < at.size(); ++k) u[k] = (at.s[k] - point.z_mid_mm) / point.z_half_mm;
  const std::span<const double> size = legendre(function.pattern.degree, u, room.get() + at.size());
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t k = 0; k < at.size(); ++k) columns[j][k] = size[k] * constant[j][k];
}

/// Readings that are corrected by a stated height were read there.
static TermContext context_of(const Effect& effect, const LinearisationPoint& point,
                              const PointPart& part) {
  TermContext at = point.context(part);
  if (effect.stated && effect.stated->kind == Influence::Kind::probe_height)
    at.height_mm += effect.stated->value;
  return at;
}

void fill(const Hypothesis& hypothesis, const LinearisationPoint& point, const PointPart& part,
          std::span<double* const> columns) {
  if (!hypothesis.effect) return fill_pattern(hypothesis.pattern, point, part, columns);
  const EffectTerm& term = hypothesis.effect->term;
  if (hypothesis.free.empty())
    return fill_columns(term, context_of(*hypothesis.effect, point, part), hypothesis.shape,
                        columns);
  const std::size_t all = linear_count(term, hypothesis.shape);
  expects(all <= most_parameters, "a term has a few linear parameters");
  const std::unique_ptr<double[]> spare = room_for(part.size() * all);
  double* target[most_parameters];
  for (std::size_t j = 0; j < all; ++j) target[j] = spare.get() + j * part.size();
  for (std::size_t j = 0; j < hypothesis.free.size(); ++j) target[hypothesis.free[j]] = columns[j];
  fill_columns(term, context_of(*hypothesis.effect, point, part), hypothesis.shape, {target, all});
}

Hypothesis of_effect(const Effect& effect, TermShape shape, std::vector<std::size_t> free,
                     double tests) {
  Hypothesis made;
  made.effect = &effect;
  made.shape = shape;
  made.free = std::move(free);
  made.tests = tests;
  return made;
}

Hypothesis of_effect(const char* id, TermShape shape, std::vector<std::size_t> free, double tests) {
  const Effect* effect = find_effect(id);
  expects(effect != nullptr, "an effect of the catalogue");
  return of_effect(*effect, shape, std::move(free), tests);
}

std::size_t columns_of(std::span<const Hypothesis> list) {
  std::size_t sum = 0;
  for (const Hypothesis& h : list) sum += h.columns();
  return sum;
}

bool is_linearised_at_its_size(const Hypothesis& h) {
  return h.effect && h.effect->refinement && h.effect->refinement->linearises;
}

bool same(const Hypothesis& a, const Hypothesis& b) {
  const auto pattern = [](const Pattern& p) {
    return std::tie(p.kind, p.order, p.spindle, p.degree, p.in_time, p.frequency, p.angle_rad,
                    p.position_mm, p.width_rad, p.length_mm);
  };
  return a.effect == b.effect && a.free == b.free && a.tests == b.tests && a.shape == b.shape &&
         pattern(a.pattern) == pattern(b.pattern);
}

bool same(std::span<const Hypothesis> a, std::span<const Hypothesis> b) {
  return std::ranges::equal(
      a, b, [](const Hypothesis& one, const Hypothesis& other) { return same(one, other); });
}

std::vector<double> contribution(const LinearisationPoint& point, std::span<const Hypothesis> terms,
                                 std::span<const double> linear, int threads) {
  std::vector<double> out(point.size(), 0.0);
  const std::size_t count = columns_of(terms);
  if (count == 0) return out;
  const auto add_part = [&](const PointPart& at, std::span<double* const> column) {
    std::size_t next = 0;
    for (const Hypothesis& h : terms) {
      fill(h, point, at, column.subspan(next, h.columns()));
      next += h.columns();
    }
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = 0; k < at.size(); ++k) out[at.begin + k] += linear[j] * column[j][k];
  };
  for_each_index((point.size() + part_rows - 1) / part_rows, threads, [&](std::size_t p) {
    std::vector<double> buffer(count * chunk);
    std::vector<double*> column(count);
    for (std::size_t j = 0; j < count; ++j) column[j] = buffer.data() + j * chunk;
    PointRoom room;
    const std::size_t last = std::min((p + 1) * part_rows, point.size());
    for (std::size_t begin = p * part_rows; begin < last; begin += chunk) {
      const PointPart at = point.part(begin, std::min(begin + chunk, last), room);
      for_each_side(at, [&](const PointPart& side) { add_part(side, column); });
    }
  });
  return out;
}

}  // namespace trueaxis::diagnose_detail
