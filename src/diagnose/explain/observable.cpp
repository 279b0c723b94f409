// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/observable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/never.hpp"
#include "base/number.hpp"
#include "diagnose/search/causes.hpp"
#include "diagnose/search/scan_list.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double seen = 0.5;      // power below which an effect counts as not observable
constexpr double no_size = 1e-2;  // mm or rad, where the entry names none
constexpr double nearly_absorbed = 0.05;
constexpr double beyond_sense = 1e2;      // times the largest typical size: no size is found
constexpr double typical_range_mm = 0.5;  // of a gauge, what its nonlinearity is a share of

/// Why the stream cannot show an effect at all; empty: it may.
std::string why_not(const Requirement& needs, const LinearisationPoint& point) {
  if (needs.time && !point.has_time) return "the stream has no t: give a time for every reading";
  if (needs.length && !point.has_position) return "one section shows nothing along Z";
  return "";
}

/// Whether the line of an effect can be looked for, where nothing but a scan does so.
bool is_searched(const Effect& effect, const std::vector<Scan>& scans) {
  using enum SpectralLine::In;
  if (!effect.line || (effect.line->in != time && effect.line->in != slide)) return true;
  return std::ranges::any_of(scans, [&](const Scan& scan) {
    return !scan.pattern && scan.make(scan.high).effect == &effect;
  });
}

double size_of(const Effect& effect, const LinearParameter& linear) {
  const EffectParameter* p = size_for(effect, linear);
  return p && p->high > 0.0 ? p->high : no_size;
}

std::string percent_left(double share) {
  const double least = 1e-4;
  return share < least ? "less than 0.01 %" : significant(100.0 * share, 2) + " %";
}

/// An effect at its typical shape; and in a form with limits of its own.
Typical typical_of(const Effect& effect, const SearchForm& form, const LinearisationPoint& point) {
  TermShape shape = typical_shape(effect, point);
  shape.range_mm = std::max(typical_range_mm, point.range_x_mm);
  if (!form.told.empty() && form.starts.parameter)
    shape.*form.starts.parameter = value_in(form.starts.in, form.starts.values.front(), point);
  const LinearParameter linear = linear_parameters(effect.term, shape)[0];
  return {of_effect(effect, shape, form.free), size_of(effect, linear), linear.unit,
          std::string(form.told)};
}

/// A wave along Z that the pass of most turns makes one undulation per revolution, such as feed
/// marks of half the probe's feed. None: the effect has no such period.
std::optional<Typical> once_per_revolution(const Effect& effect, const LinearisationPoint& point) {
  const auto* wave = std::get_if<PeriodicInZ>(&effect.term);
  if (wave == nullptr || !effect.line) return {};
  const auto travel = [&](PointColumn x, const Pass& pass) {
    return point.at(x, pass.end - 1) - point.at(x, pass.begin);
  };
  const auto turns = [&](const Pass& pass) {
    return pass.feed_sign == 0 ? 0.0 : std::abs(travel(&PointPart::c, pass)) / two_pi;
  };
  const auto longest = std::ranges::max_element(point.passes, {}, turns);
  if (longest == point.passes.end() || turns(*longest) < 1.0) return {};
  const double feed = two_pi * travel(&PointPart::s, *longest) / travel(&PointPart::c, *longest);
  const double period = (wave->turns == 0.0 ? std::abs(feed) : feed) / (1.0 + wave->turns);
  const EffectParameter* range = parameter_for(effect, "period_mm");
  if (range == nullptr || period < range->low || period > range->high) return {};
  Typical out = typical_of(effect, {.free = effect.search.forms.front().free}, point);
  out.hypothesis.shape.period_mm = period;
  out.form = fmt::format("of the period {:.3g} mm: ", period);
  return out;
}

/// The share of columns that is left after others, RMS.
double left_of(const Joint& joint, const Columns& columns, const Columns& beside) {
  const Projection projection = project(joint.equations.total(), beside);
  double kept = 0.0, whole = 0.0;
  for (const std::size_t column : columns) {
    const auto c = static_cast<Eigen::Index>(column);
    kept += std::max(0.0, projection.gram(c, c)), whole += projection.norm2(c);
  }
  return whole > 0.0 ? std::sqrt(kept / whole) : 0.0;
}

/// The term that takes columns in which the surface alone would leave; none: the surface does.
std::optional<std::size_t> absorbing_term(const Joint& joint, const Columns& columns) {
  if (left_of(joint, columns, joint.equations.base()) < nearly_absorbed) return {};
  std::optional<std::size_t> most;
  double largest = 0.0;
  for (std::size_t t = 0; t < joint.fitted; ++t) {
    Columns beside = joint.equations.base();
    beside.insert(beside.end(), joint.places[t].begin(), joint.places[t].end());
    const double taken = 1.0 - left_of(joint, columns, beside);
    if (taken > largest) largest = taken, most = t;
  }
  return most;
}

}  // namespace

std::vector<Typical> typical_effects(const Problem& problem) {
  std::vector<Typical> list;
  for (const Effect* effect : problem.effects) {
    if (effect->needs.cylinder && problem.point.base.tapers) continue;
    const std::vector<SearchForm>& forms = effect->search.forms;
    list.push_back(typical_of(*effect, {.free = forms.front().free}, problem.point));
    for (const SearchForm& form : forms)
      if (!form.told.empty()) list.push_back(typical_of(*effect, form, problem.point));
    if (auto wave = once_per_revolution(*effect, problem.point)) list.push_back(*std::move(wave));
  }
  return list;
}

double detection_power(double lambda, std::size_t columns, const Family& family, double level) {
  if (!(lambda > 0.0) || columns == 0) return level;
  return infer::detection_power(lambda, static_cast<double>(columns), known_sigma,
                                family.single_level(level));
}

double typical_lambda(const Projection& projection, const Columns& columns, double size,
                      double sigma_mm) {
  double trace = 0.0;
  const std::size_t count = std::min<std::size_t>(columns.size(), 2);
  for (std::size_t j = 0; j < count; ++j) {
    const auto c = static_cast<Eigen::Index>(columns[j]);
    trace += std::max(0.0, projection.gram(c, c));
  }
  return size * size * trace / static_cast<double>(count) / (sigma_mm * sigma_mm);
}

std::vector<Unobservable> unobservable_effects(const Problem& problem, const Model& model,
                                               const std::vector<AmbiguousFinding>& findings,
                                               double sigma_mm) {
  const LinearisationPoint& point = problem.point;
  const std::vector<Typical> all = typical_effects(problem);
  std::vector<Hypothesis> list = model.terms;
  for (const Typical& t : all) list.push_back(t.hypothesis);
  const Joint joint(problem, model.phi, list, model.terms.size());
  const Columns& taken = joint.solution.columns;
  const Projection projection = project(joint.equations.total(), taken);
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  const std::vector<Scan> scans = scans_of(problem);
  const double level = model.family.single_level(problem.false_alarm);
  const double needed[] = {infer::required_lambda(1.0, known_sigma, level, seen),
                           infer::required_lambda(2.0, known_sigma, level, seen)};
  std::vector<Unobservable> out;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Typical& t = all[k];
    const Effect& effect = *t.hypothesis.effect;
    const bool named =
        std::ranges::any_of(model.terms, [&](const Hypothesis& h) { return h.effect == &effect; });
    const bool listed = std::ranges::any_of(
        out, [&](const Unobservable& h) { return h.typical.hypothesis.effect == &effect; });
    const bool in_a_class = std::ranges::any_of(findings, [&](const AmbiguousFinding& f) {
      return std::ranges::any_of(
          f.found.members, [&](const Candidate& c) { return c.hypothesis.effect == &effect; });
    });
    if (named || listed || in_a_class) continue;
    const Columns& own = joint.places[model.terms.size() + k];
    Unobservable h{t, {}, 0.0, 0.0};
    h.entry.effect = effect.id;
    std::string why = why_not(effect.needs, point);
    if (why.empty() && !is_searched(effect, scans))
      why = "the passes are too short or too coarse to show its wave: probe a longer length";
    const bool can = why.empty();
    const double lambda = can ? typical_lambda(projection, own, t.size, sigma_mm) : 0.0;
    h.power = can ? detection_power(lambda, std::min<std::size_t>(own.size(), 2), model.family,
                                    problem.false_alarm)
                  : 0.0;
    if (h.power >= seen) continue;
    double kept = 0.0, whole = 0.0;
    double worst = 0.0;
    // Without what it needs its harm is not known either: that of a delay goes by the speed.
    for (std::size_t j = 0; can && j < std::min<std::size_t>(own.size(), 2); ++j) {
      const auto c = static_cast<Eigen::Index>(own[j]);
      kept += std::max(0.0, projection.gram(c, c)), whole += projection.norm2(c);
      const Eigen::VectorXd right = joint.equations.total()(taken, c);
      const Eigen::VectorXd change = (joint.solution.inverse * right).head(n);
      worst = std::max(worst, axis_shift(point, change, Eigen::MatrixXd::Zero(n, n)).value_mm);
    }
    h.axis_bias_mm = worst * t.size;
    h.entry.axis_bias_per_unit = {worst, 0.0, "mm/(" + t.unit + ")", ""};
    h.entry.axis_bias_typical = {h.axis_bias_mm, 0.0, "mm", ""};
    h.entry.detectable_unit = t.unit;
    const double times =
        lambda > 0.0 ? std::sqrt(needed[own.size() < 2 ? 0 : 1] / lambda) : beyond_sense;
    h.entry.detectable =
        times < beyond_sense ? times * t.size : std::numeric_limits<double>::infinity();
    const double share = whole > 0.0 ? std::sqrt(kept / whole) : 0.0;
    if (!can) {
      h.entry.why = why;
    } else if (whole <= 0.0) {
      h.entry.why = "the plan has no readings that show it";
    } else if (share < nearly_absorbed) {
      const std::optional<std::size_t> finding = absorbing_term(joint, own);
      const bool elsewhere =
          point.base.face && !effect.needs.stream;  // its entry speaks of an axis
      const std::string by(finding                      ? "the cause " + model.terms[*finding].id()
                           : elsewhere                  ? "height and tilt of the face"
                           : effect.absorbed_by.empty() ? "the surface's own parameters"
                                                        : effect.absorbed_by);
      h.entry.why = fmt::format("absorbed by {}: {} of it remains", by, percent_left(share));
    } else {
      const bool small = t.unit == "mm" && h.entry.detectable < 1.0, angle = t.unit == "rad";
      const double shown = h.entry.detectable * (small ? 1.0 / mm_per_um : edge_factor(t.unit));
      h.entry.why = "too small compared with the noise at " +
                    or_never(h.entry.detectable, t.unit,
                             fmt::format("its typical size: found from {:.3g} {} on", shown,
                                         small   ? "µm"
                                         : angle ? "deg"
                                                 : t.unit),
                             "any size that occurs");
    }
    h.entry.why.insert(0, t.form);
    out.push_back(std::move(h));
  }
  std::ranges::stable_sort(out, [](const Unobservable& a, const Unobservable& b) {
    return a.axis_bias_mm > b.axis_bias_mm;
  });
  return out;
}

}  // namespace trueaxis::diagnose_detail
