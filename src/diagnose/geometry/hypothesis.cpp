// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/hypothesis.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/threads.hpp"
#include "math/sincos.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t most_parameters = 8;
constexpr std::size_t chunk = 512, part_rows = 64 * chunk;  // of a thread
constexpr double nothing_left = 80.0;  // a bump 9 widths away is below the rounding of its top

/// An angle of few turns in −π … π.
double wrapped(double angle_rad) {
  while (angle_rad > std::numbers::pi) angle_rad -= two_pi;
  while (angle_rad < -std::numbers::pi) angle_rad += two_pi;
  return angle_rad;
}

/// By Bonnet's recursion, which also holds a little outside [−1, 1], where a probe may overrun.
double legendre(int degree, double u) {
  double before = 1.0, now = u;
  if (degree == 0) return 1.0;
  for (int l = 1; l < degree; ++l)
    before =
        std::exchange(now, boost::math::legendre_next(static_cast<unsigned>(l), u, now, before));
  return now;
}

void fill_pattern(const Pattern& of, const LinearisationPoint& point, const PointPart& at,
                  std::span<double* const> columns) {
  const double first = point.time.front(), lasted = point.time.back() - first;
  const std::size_t count = at.size();
  std::vector<double> angle(count), sine(count), cosine(count);
  for (std::size_t k = 0; k < count; ++k) {
    angle[k] = of.order * (of.spindle ? at.c[k] : at.theta[k]);
    if (of.kind == Pattern::Kind::line)
      angle[k] -= two_pi * of.frequency * (of.in_time ? at.time[k] : at.s[k]);
  }
  if (of.kind != Pattern::Kind::bump) sincos(angle, sine, cosine);
  for (std::size_t k = 0; k < count; ++k) {
    double size = of.spindle ? 1.0 : at.dx_dnormal[k];
    if (of.kind == Pattern::Kind::bump) {
      const double v = wrapped(at.theta[k] - of.angle_rad) / of.width_rad;
      const double w = point.has_position && of.length_mm > 0.0
                           ? (at.s[k] - of.position_mm) / of.length_mm
                           : 0.0;
      const double away = v * v + w * w;
      columns[0][k] = away < nothing_left ? size * std::exp(-0.5 * away) : 0.0;
      continue;
    }
    if (of.kind == Pattern::Kind::fourier_legendre) {
      const double u = of.in_time ? (lasted > 0.0 ? 2.0 * (at.time[k] - first) / lasted - 1.0 : 0.0)
                                  : (at.s[k] - point.z_mid_mm) / point.z_half_mm;
      size *= legendre(of.degree, u);
    }
    columns[0][k] = size * cosine[k];
    if (columns.size() > 1) columns[1][k] = size * sine[k];
  }
}

}  // namespace

void raise_degree(const Hypothesis& function, const LinearisationPoint& point, const PointPart& at,
                  std::span<const double* const> constant, std::span<double* const> columns) {
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double u = (at.s[k] - point.z_mid_mm) / point.z_half_mm;
    const double size = legendre(function.pattern.degree, u);
    for (std::size_t j = 0; j < columns.size(); ++j) columns[j][k] = size * constant[j][k];
  }
}

void fill(const Hypothesis& hypothesis, const LinearisationPoint& point, const PointPart& part,
          std::span<double* const> columns) {
  if (!hypothesis.effect) return fill_pattern(hypothesis.pattern, point, part, columns);
  const Term& term = hypothesis.effect->term;
  if (hypothesis.free.empty())
    return fill_columns(term, point.context(part), hypothesis.shape, columns);
  const std::size_t all = linear_parameters(term, hypothesis.shape).size();
  expects(all <= most_parameters, "a term has a few linear parameters");
  std::vector<double> spare(part.size() * all);
  double* target[most_parameters];
  for (std::size_t j = 0; j < all; ++j) target[j] = spare.data() + j * part.size();
  for (std::size_t j = 0; j < hypothesis.free.size(); ++j) target[hypothesis.free[j]] = columns[j];
  fill_columns(term, point.context(part), hypothesis.shape, {target, all});
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

bool same(const Hypothesis& a, const Hypothesis& b) {
  const auto shape = [](const TermShape& s) {
    return std::tie(s.order, s.lever_from_mm, s.decay_length_mm, s.degree, s.period_mm,
                    s.frequency_hz, s.time_constant_s, s.onset_s, s.reference_x_mm, s.range_mm);
  };
  const auto pattern = [](const Pattern& p) {
    return std::tie(p.kind, p.order, p.spindle, p.degree, p.in_time, p.frequency, p.angle_rad,
                    p.position_mm, p.width_rad, p.length_mm);
  };
  return a.effect == b.effect && a.free == b.free && a.tests == b.tests &&
         shape(a.shape) == shape(b.shape) && pattern(a.pattern) == pattern(b.pattern);
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
