// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/causes.hpp"

#include <algorithm>
#include <cmath>

#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using When = SearchRange::When;

constexpr double no_motion = 1e-9;
constexpr double duration_range = 6.0;  // ln: a first step of 0.06 is half way to the next length
constexpr int rounding_harmonics = 3;   // the next is 1/4 of the first, and σ takes it away

bool both_ways(const LinearisationPoint& point) {
  const Extent v = range_of(point.velocity);  // of the passes
  return v.low < -no_motion && v.high > no_motion;
}

bool can_show(const Requirement& needs, const Problem& problem) {
  const LinearisationPoint& point = problem.point;
  return (!needs.time || point.has_time) && (!needs.length || problem.resolution.degrees > 0) &&
         (!needs.cone || point.base.face || std::abs(point.tan_half_angle) > least_tangent) &&
         (!needs.cylinder || !point.base.tapers) && (!needs.both_feeds || both_ways(point));
}

/// Whether the stream has what the values are written in.
bool can_start(const ShapeValues& starts, const Problem& problem) {
  const bool seen = problem.point.swing_mm > least_swing_mm && !problem.resolution.sections;
  return starts.in != ShapeValues::In::per_swing || seen;
}

/// What the choice of a variant counts as, for an order.
double tests_of(const SearchRange& range, bool alone) {
  if (range.tests > 0.0) return range.tests;
  std::size_t sum = 0;
  for (const SearchForm& form : range.forms)
    sum += alone ? 1 : std::max<std::size_t>(1, form.starts.values.size());
  return static_cast<double>(sum);
}

/// Of M angles lobes of the order M/2 show one column in place of two: which of the linear
/// parameters those are. Their other phase is nowhere.
std::vector<std::size_t> visible(const Effect& effect, const SearchForm& form,
                                 const TermShape& shape, const Problem& problem) {
  if (!problem.resolution.half_seen || shape.order != problem.resolution.half_seen)
    return form.free;
  using Factor = LinearParameter::Factor;
  const bool cosine =
      std::abs(std::cos(shape.order * problem.point.at(&PointPart::theta, 0))) > 0.5;
  const auto names = linear_parameters(effect.term, shape);
  std::vector<std::size_t> out;
  for (std::size_t j = 0; j < names.size(); ++j) {
    const bool asked = form.free.empty() || std::ranges::find(form.free, j) != form.free.end();
    if (asked && names[j].factor == (cosine ? Factor::cosine : Factor::sine)) out.push_back(j);
  }
  return out;
}

/// @param alone one start of each form
void add_form(const Effect& effect, const SearchForm& form, TermShape shape, bool alone,
              double tests, const Problem& problem, std::vector<Hypothesis>& list) {
  if (problem.resolution.degrees < form.degrees || !can_start(form.starts, problem)) return;
  const std::vector<std::size_t> free = visible(effect, form, shape, problem);
  const auto add = [&] { list.push_back(of_effect(effect, shape, free, tests)); };
  const ShapeValues& starts = form.starts;
  if (starts.values.empty()) return add();
  for (std::size_t k = 0; k < starts.values.size(); ++k) {
    if (alone && k != starts.alone) continue;
    shape.*starts.parameter = value_in(starts.in, starts.values[k], problem.point);
    add();
  }
}

/// All degrees up to each, and each alone.
void add_degrees(const Effect& effect, TermShape shape, const Problem& problem,
                 std::vector<Hypothesis>& list) {
  const int first = std::get<PolynomialInZ>(effect.term).first;
  const double tests = tests_of(effect.search, false);
  const int highest = std::min(effect.search.highest_degree, problem.resolution.degrees + 1);
  for (shape.degree = std::max(first, effect.search.lowest_degree); shape.degree <= highest;
       ++shape.degree) {
    list.push_back(of_effect(effect, shape, {}, tests));
    const auto last = static_cast<std::size_t>(shape.degree - first);
    if (last > 0) list.push_back(of_effect(effect, shape, {last}, tests));
  }
}

bool is_of_scale(const Effect* effect) {
  return effect && effect->line && effect->line->in == SpectralLine::In::sensed;
}

/// The error of rounding has a known period: it is tried where a scan does not reach.
void add_rounding(const Effect& effect, TermShape shape, double step_mm,
                  std::vector<Hypothesis>& list) {
  for (int k = 1; k <= rounding_harmonics; ++k) {
    shape.period_mm = step_mm / k;
    list.push_back(of_effect(effect, shape, {}, rounding_harmonics));
  }
}

/// A tilt with a radial motion of its own phase.
bool is_any_motion(const EffectTerm& term, const SearchForm& form) {
  const auto* harmonic = std::get_if<Harmonic>(&term);
  return harmonic && harmonic->envelope == Harmonic::Envelope::lever && form.free.empty();
}

double turns_of_longest_pass(const LinearisationPoint& point) {
  double most = 1.0;
  for (const Pass& pass : point.passes)
    most = std::max(most, std::abs(point.c[pass.end - 1] - point.c[pass.begin]) / two_pi);
  return most;
}

/// Reach of a form at an end that leaves the middle half of the length as it is, within 14 %.
double longest_end_mm(const LinearisationPoint& point) { return 0.25 * point.z_half_mm; }

/// How many orders a harmonic of free order is tried at.
double orders_of(const Effect& effect, const Resolution& resolution) {
  return effect.search.highest_order > 0 ? effect.search.highest_order - 1 : resolution.harmonics;
}

}  // namespace

double value_in(ShapeValues::In in, double value, const LinearisationPoint& point) {
  switch (in) {
    case ShapeValues::In::half_lengths:
      return point.z_mid_mm + value * point.z_half_mm;
    case ShapeValues::In::per_length:
      return 2.0 * point.z_half_mm / value;
    case ShapeValues::In::turns:
      return std::min(value * 2.0 * point.z_half_mm / turns_of_longest_pass(point),
                      longest_end_mm(point));
    case ShapeValues::In::per_swing:
      return std::max(point.swing_mm, least_swing_mm) / value;
    case ShapeValues::In::duration:
      return value * range_of(point.time).length();
    case ShapeValues::In::instant:
      return point.time[static_cast<std::size_t>(value * static_cast<double>(point.size()))];
    case ShapeValues::In::itself:
      break;
  }
  return value;
}

TermShape typical_shape(const Effect& effect, const LinearisationPoint& point) {
  TermShape shape;
  shape.reference_x_mm = point.reference_x_mm;
  shape.range_mm = point.range_x_mm;
  shape.ball_radius_mm = point.ball_radius_mm;
  for (const ShapeValues& v : effect.typical)
    shape.*v.parameter = value_in(v.in, v.values.front(), point);
  return shape;
}

bool is_rounding(const Hypothesis& h, const LinearisationPoint& point, double step_mm) {
  if (!(step_mm > 0.0) || !is_of_scale(h.effect)) return false;
  const double harmonic = step_mm / h.shape.period_mm;
  return harmonic > 0.5 && std::abs(harmonic - std::round(harmonic)) * point.swing_mm < step_mm;
}

std::vector<Hypothesis> preset_causes(const Problem& problem) {
  std::vector<Hypothesis> list;
  const bool frames_told = problem.point.reindexed || problem.point.two_sided;
  for (const Effect* effect : problem.effects) {
    const SearchRange& range = effect->search;
    if (range.when == When::scanned || range.when == When::at_orders ||
        (range.when == When::told_apart && !frames_told) || !can_show(effect->needs, problem))
      continue;
    TermShape shape = typical_shape(*effect, problem.point);
    if (problem.rounding_mm > 0.0 && is_of_scale(effect))
      add_rounding(*effect, shape, problem.rounding_mm, list);
    if (range.highest_degree > 0) {
      add_degrees(*effect, shape, problem, list);
    } else if (!has_free_order(*effect)) {
      for (const SearchForm& form : range.forms)
        add_form(*effect, form, shape, false, tests_of(range, false), problem, list);
    } else {
      const double tests = tests_of(range, true) * orders_of(*effect, problem.resolution);
      for (int n = 2; n <= std::max(problem.resolution.harmonics, problem.resolution.half_seen);
           ++n) {
        if (range.highest_order > 0 && n > range.highest_order) break;
        shape.order = n;
        for (const SearchForm& form : range.forms)
          add_form(*effect, form, shape, true, tests, problem, list);
      }
    }
  }
  return list;
}

std::vector<Hypothesis> causes_of_order(const Problem& problem, int order) {
  std::vector<Hypothesis> list;
  for (const Effect* effect : problem.effects) {
    const SearchRange& range = effect->search;
    if (!has_free_order(*effect) || range.when == When::always || !can_show(effect->needs, problem))
      continue;
    const bool two = has_two_orders(effect->term);
    const double tests = tests_of(range, false) * orders_of(*effect, problem.resolution);
    TermShape shape = typical_shape(*effect, problem.point);
    for (const int own : {order, order / 2}) {
      const bool half = own != order;
      if (own < 2 || (range.highest_order > 0 && own > range.highest_order) ||
          (half && (!two || 2 * own != order)))
        continue;
      shape.order = own;
      for (const SearchForm& form : range.forms) {
        if (is_any_motion(effect->term, form)) continue;  // roundness that grows stands for it
        const bool second = two && form.free.empty();
        if (second ? 2 * own > problem.resolution.harmonics : half) continue;
        add_form(*effect, form, shape, false, tests, problem, list);
      }
    }
  }
  return list;
}

Extent dates_of_steps(const LinearisationPoint& point) {
  const std::size_t size = point.size();
  const std::size_t first = std::min(least_beside_step, size / 2), last = size - first;
  const auto before = [&](std::size_t k) {
    return k == 0 ? point.time[0] : 0.5 * (point.time[k - 1] + point.time[k]);
  };
  return {before(first), before(last)};
}

std::vector<Hypothesis> neighbours(const Hypothesis& h, const LinearisationPoint& point,
                                   double step) {
  std::vector<Hypothesis> list;
  const auto vary = [&](auto change) {
    for (const double d : {-step, step}) {
      Hypothesis other = h;
      change(other, d);
      list.push_back(std::move(other));
    }
  };
  if (!h.effect) {
    if (h.pattern.kind != Pattern::Kind::bump) return list;
    vary([](Hypothesis& o, double d) { o.pattern.angle_rad += d * o.pattern.width_rad * 8.0; });
    vary([](Hypothesis& o, double d) { o.pattern.width_rad *= std::exp(8.0 * d); });
    if (h.pattern.length_mm > 0.0) {
      vary([](Hypothesis& o, double d) { o.pattern.position_mm += d * o.pattern.length_mm * 8.0; });
      vary([](Hypothesis& o, double d) { o.pattern.length_mm *= std::exp(8.0 * d); });
    }
    return list;
  }
  if (!h.effect->refinement) return list;
  const Refinement& r = *h.effect->refinement;
  if (r.reader && std::ranges::find(h.free, *r.reader) == h.free.end()) return list;
  const Extent time = range_of(point.time), dates = dates_of_steps(point);
  const auto within = [&](double onset_s, double duration_s) {
    return std::clamp(onset_s, dates.low, std::max(dates.low, dates.high - duration_s));
  };
  vary([&](Hypothesis& o, double d) {
    double& value = o.shape.*r.parameter;
    switch (r.by) {
      case Refinement::By::factor:
        value = std::clamp(value * std::exp(r.range * d), r.low, r.high);
        break;
      case Refinement::By::at_end:
        value = std::min(std::max(value * std::exp(r.range * d), r.low), longest_end_mm(point));
        break;
      case Refinement::By::sum:
        value = std::clamp(value + r.range * d, r.low, r.high);
        break;
      case Refinement::By::duration:
        value = within(value + d * time.length(), o.shape.duration_s);
        break;
      case Refinement::By::lever: {
        // The envelope 1 + u κ, κ = half length / (middle − bearing).
        const double kappa = point.z_half_mm / (point.z_mid_mm - value) + d;
        if (kappa > r.low && kappa < r.high) value = point.z_mid_mm - point.z_half_mm / kappa;
      }
    }
  });
  if (r.by == Refinement::By::duration && h.shape.duration_s > 0.0)  // about its middle
    vary([&](Hypothesis& o, double d) {
      double& lasts = o.shape.duration_s;
      const double middle = o.shape.onset_s + 0.5 * lasts;
      lasts = std::clamp(lasts * std::exp(duration_range * d),
                         time.length() / static_cast<double>(point.size()), dates.length());
      o.shape.onset_s = within(middle - 0.5 * lasts, lasts);
    });
  return list;
}

}  // namespace trueaxis::diagnose_detail
