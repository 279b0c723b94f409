// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/observable.hpp"

#include <algorithm>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <cstdio>

#include "diagnose/search/causes.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double seen = 0.5;           // power below which an effect counts as not observable
constexpr double no_prior_rad = 1e-2;  // a size for those whose catalogue entry names none
constexpr double nearly_absorbed = 0.05;
constexpr double typical_range_mm = 0.5;  // of a gauge, what its nonlinearity is a share of

bool possible(const Effect& effect, const LinearisationPoint& point, std::string& why) {
  const auto id = effect.id;
  if (!point.has_time && (id == "thermal.drift" || id == "environment.vibration" ||
                          id == "probe.latency" || id == "probe.lag" || id == "part.slip")) {
    why = "the stream has no t: give a time for every reading";
    return false;
  }
  const bool along =
      id == "part.barrel" || id == "part.taper" || id == "part.bow" || id == "part.waviness" ||
      id == "part.feed_marks" || id == "part.chuck_lobing" || id == "slide.z_straightness" ||
      id == "slide.xz_parallelism" || id == "slide.leadscrew_periodic" || id == "slide.backlash" ||
      id == "spindle.tilt_synchronous" || id == "probe.tilt";
  if (!point.has_position && along) {
    why = "one section shows nothing along Z";
    return false;
  }
  return true;
}

double size_of(const Effect& effect, const LinearParameter& linear) {
  for (const EffectParameter& p : effect.parameters) {
    const bool same = linear.name == p.name ||
                      (linear.name.starts_with(p.name) && linear.name.size() > p.name.size() &&
                       linear.name[p.name.size()] == '_');
    if (same && p.high > 0.0) return p.high;
  }
  return linear.unit == "rad" ? no_prior_rad : 1e-2;
}

TermShape typical_shape(const Effect& effect, const LinearisationPoint& point) {
  TermShape s;
  s.reference_x_mm = point.reference_x_mm;
  s.range_mm = std::max(typical_range_mm, point.range_x_mm);
  s.lever_from_mm = effect.id == "part.chuck_lobing" ? point.z_mid_mm - point.z_half_mm : -250.0;
  s.decay_length_mm = 40.0;
  s.time_constant_s = 0.0;
  if (effect.id == "part.chuck_lobing" || effect.id == "probe.pretravel") s.order = 3.0;
  if (effect.id == "spindle.asynchronous") s.order = 0.43;
  if (effect.id == "part.waviness" || effect.id == "slide.leadscrew_periodic")
    s.period_mm = 2.0 * point.z_half_mm / 7.3;
  if (effect.id == "part.feed_marks") s.period_mm = 0.173;
  if (effect.id == "probe.cyclic") s.period_mm = 0.137;
  if (effect.id == "environment.vibration") s.frequency_hz = 7.3;
  if (effect.id == "thermal.drift") s.time_constant_s = 600.0;
  if (effect.id == "part.slip") s.onset_s = point.time[point.size() / 2];
  return s;
}

std::vector<std::size_t> typical_free(std::string_view id) {
  if (id == "part.chuck_lobing" || id == "part.roundness" || id == "part.slip") return {0, 1};
  if (id == "part.barrel" || id == "slide.backlash" || id == "probe.nonlinearity" ||
      id == "probe.pretravel" || id == "thermal.drift")
    return {0};
  return {};
}

}  // namespace

std::vector<Typical> typical_effects(const LinearisationPoint& point) {
  std::vector<Typical> list;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check || std::holds_alternative<std::monostate>(effect.term)) continue;
    if (effect.id == "part.taper" && point.base.tapers) continue;
    const TermShape shape = typical_shape(effect, point);
    const auto linear = linear_parameters(effect.term, shape);
    Typical t{of_effect(effect.id.data(), shape, typical_free(effect.id)),
              size_of(effect, linear[0]), linear[0].unit == "rad" ? "deg" : linear[0].unit,
              linear[0].unit == "rad" ? 1.0 / rad_per_deg : 1.0, ""};
    list.push_back(std::move(t));
    Typical other = list.back();
    if (effect.id == "probe.nonlinearity") {
      other.form = "of the third degree: ";
      other.hypothesis.free = {1};
    } else if (effect.id == "probe.cyclic") {
      other.form = "of a period twice what is sensed: ";
      other.hypothesis.shape.period_mm = 2.0 * std::max(sensed_swing(point), least_swing_mm);
    } else {
      continue;
    }
    list.push_back(std::move(other));
  }
  return list;
}

double detection_power(double lambda, std::size_t columns, const Family& family, double level) {
  if (!(lambda > 0.0) || columns == 0) return level;
  // The statistic with these degrees of freedom that is as improbable as the threshold of two.
  const double p = std::exp(-0.5 * family.threshold(level));
  const auto q = static_cast<double>(columns);
  const boost::math::chi_squared central(q);
  const double threshold = quantile(complement(central, p));
  if (lambda > 40.0 * threshold) return 1.0;
  return cdf(complement(boost::math::non_central_chi_squared(q, lambda), threshold));
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
                                               double sigma_mm) {
  const LinearisationPoint& point = problem.point;
  const std::vector<Typical> all = typical_effects(point);
  std::vector<Hypothesis> list = model.terms;
  for (const Typical& t : all) list.push_back(t.hypothesis);
  const Joint joint(problem, model.phi, list, model.terms.size());
  const Columns& taken = joint.solution.columns;
  const Projection projection = project(joint.equations.total(), taken);
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  std::vector<Unobservable> out;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Typical& t = all[k];
    const Effect& effect = *t.hypothesis.effect;
    const bool named =
        std::ranges::any_of(model.terms, [&](const Hypothesis& h) { return h.effect == &effect; });
    const bool listed = std::ranges::any_of(
        out, [&](const Unobservable& h) { return h.typical.hypothesis.effect == &effect; });
    if (named || listed) continue;
    const Columns& own = joint.places[model.terms.size() + k];
    Unobservable h{t, {}, 0.0, 0.0};
    h.entry.effect = effect.id;
    std::string why;
    const bool can = possible(effect, point, why);
    const double lambda = can ? typical_lambda(projection, own, t.size, sigma_mm) : 0.0;
    h.power = can ? detection_power(lambda, std::min<std::size_t>(own.size(), 2), model.family,
                                    problem.false_alarm)
                  : 0.0;
    if (h.power >= seen) continue;
    double kept = 0.0, whole = 0.0;
    double worst = 0.0;
    for (std::size_t j = 0; j < std::min<std::size_t>(own.size(), 2); ++j) {
      const auto c = static_cast<Eigen::Index>(own[j]);
      kept += std::max(0.0, projection.gram(c, c)), whole += projection.norm2(c);
      Eigen::VectorXd right(static_cast<Eigen::Index>(taken.size()));
      for (Eigen::Index i = 0; i < right.size(); ++i)
        right(i) = joint.equations.total()(
            static_cast<Eigen::Index>(taken[static_cast<std::size_t>(i)]), c);
      const Eigen::VectorXd change = (joint.solution.inverse * right).head(n);
      worst = std::max(worst, axis_shift(point, change, Eigen::MatrixXd::Zero(n, n)).value_mm);
    }
    h.axis_bias_mm = worst * t.size;
    h.entry.axis_bias_per_unit = {worst / t.edge, 0.0, "mm/(" + t.unit + ")", ""};
    h.entry.axis_bias_typical = {h.axis_bias_mm, 0.0, "mm", ""};
    h.entry.detectable_unit = t.unit;
    const double at_threshold = model.family.threshold(problem.false_alarm);
    h.entry.detectable = lambda > 0.0 ? t.size * t.edge * std::sqrt(at_threshold / lambda)
                                      : std::numeric_limits<double>::infinity();
    char text[256];
    const double share = whole > 0.0 ? std::sqrt(kept / whole) : 0.0;
    if (!can) {
      h.entry.why = why;
    } else if (whole <= 0.0) {
      h.entry.why = "the plan has no readings in which it shows";
    } else if (share < nearly_absorbed) {
      const std::string by(effect.absorbed_by.empty() ? "the surface's own parameters"
                                                      : effect.absorbed_by);
      std::snprintf(text, sizeof text, "absorbed by %s: %.2g %% of it is left", by.c_str(),
                    100.0 * share);
      h.entry.why = text;
    } else {
      std::snprintf(text, sizeof text,
                    "too small beside the noise at its typical size: found from %.3g %s on",
                    h.entry.detectable, t.unit.c_str());
      h.entry.why = text;
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
