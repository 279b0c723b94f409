// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/relinearised_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>

#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

const char* other_of(const Hypothesis& h) {
  if (!h.effect) return nullptr;
  return h.effect->id == "probe.lag"       ? "probe.latency"
         : h.effect->id == "probe.latency" ? "probe.lag"
                                           : nullptr;
}

bool is_lag(const Hypothesis& h) { return h.effect && h.effect->id == "probe.lag"; }

/// Whether a term moves the spindle angle that a reading tells of. (A backlash moves Z, in which X
/// is straight.)
bool turns(const Hypothesis& h) {
  const auto* shift = h.effect ? std::get_if<ArgumentShift>(&h.effect->term) : nullptr;
  return is_lag(h) || (shift != nullptr && shift->by != ArgumentShift::By::backlash);
}

/// By how much, per unit of the term.
double turn_per_unit(const Hypothesis& h, const LinearisationPoint& recorded, std::size_t reading) {
  const auto* shift = std::get_if<ArgumentShift>(&h.effect->term);
  const bool constant = shift != nullptr && shift->by == ArgumentShift::By::angle;
  return constant ? 1.0 : -recorded.speed[reading];
}

void add(std::vector<double>& to, const std::vector<double>& values, double factor = 1.0) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * values[i];
}

/// What a lag does to X: the integral of its column from 0 to T (Simpson).
std::vector<double> response_of(const Hypothesis& lag, const LinearisationPoint& point) {
  const double T = lag.shape.time_constant_s;
  std::vector<double> out(point.size(), 0.0);
  for (const auto& [share, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
    Hypothesis at = lag;
    at.shape.time_constant_s = share * T;
    add(out, contribution(point, {at}, Eigen::VectorXd::Constant(1, T)), weight / 6.0);
  }
  return out;
}

/// Moves what all terms are about to the angles that delays and lags make true, and notes what is
/// known of X: X(a) = X(a') + (a − a') ∂X/∂a.
void turn(const Given& given, const LinearisationPoint& first, const Eigen::VectorXd& found,
          const std::function<LinearisationPoint(const ProbeStream&)>& point_of, About& out) {
  out.moved = given.stream;
  Eigen::Index at = 0;
  for (Hypothesis& h : out.terms) {
    const double by = found(at);
    if (is_lag(h)) h.shape.time_constant_s = by;
    for (std::size_t i = 0; turns(h) && i < first.size(); ++i)
      out.moved->c_rad[i] += by * turn_per_unit(h, first, i);
    at += static_cast<Eigen::Index>(h.columns());
  }
  const LinearisationPoint recorded = point_of(given.stream);
  out.point = point_of(*out.moved);
  out.turned_mm = out.point.x;
  add(out.turned_mm, recorded.x, -1.0);
  at = 0;
  for (const Hypothesis& h : out.terms) {
    const Eigen::VectorXd by = found.segment(at, static_cast<Eigen::Index>(h.columns()));
    at += by.size();
    if (is_lag(h)) {
      add(out.known_mm, contribution(out.point, {h}, by));
      add(out.known_mm, response_of(h, recorded), -1.0);
      add(out.known_mm, out.turned_mm);
    } else if (turns(h)) {
      for (std::size_t i = 0; i < first.size(); ++i)
        out.known_mm[i] += by(0) * turn_per_unit(h, first, i) * out.point.dx_dc[i];
    }
  }
}

About about(const Given& given, const Problem& whole, const Model& model) {
  const LinearisationPoint& first = whole.point;
  const Joint near(whole, model.phi, model.terms, model.terms.size());
  const auto count = static_cast<Eigen::Index>(columns_of(model.terms));
  const Eigen::VectorXd found = near.solution.coefficients.tail(count);
  const FitResult extended = extended_fit(given.stream, given.options, near,
                                          contribution(first, model.terms, found), given.masked);
  About out;
  out.terms = model.terms;
  const bool again = is_diagnosable(extended) && !model.terms.empty();
  const auto point_of = [&](const ProbeStream& stream) {
    return linearise_at(stream, clampings_of(extended, given.ball_mm), first.base, first.bore);
  };
  if (!again) {
    out.point = first;
    out.known_mm.assign(first.size(), 0.0);
    out.deviation_mm = deviation_from(given.stream, first);
    return out;
  }
  out.known_mm.assign(first.size(), 0.0);
  if (std::ranges::any_of(out.terms, turns)) {
    turn(given, first, found, point_of, out);
  } else {
    out.point = point_of(given.stream);
  }
  out.deviation_mm = deviation_from(given.stream, out.point);
  add(out.deviation_mm, out.known_mm);
  return out;
}

}  // namespace

std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point) {
  std::vector<double> out(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) out[i] = stream.reading_mm[i] - point.x[i];
  if (!point.base.offset) return out;
  const double zero = median(out);
  for (double& d : out) d -= zero;
  return out;
}

RelinearisedFit::RelinearisedFit(const Given& given, const Problem& whole, const Model& model)
    : about_(about(given, whole, model)),
      problem{about_.point,      whole.mask,    whole.resolution, about_.deviation_mm,
              whole.false_alarm, whole.threads, whole.most_terms},
      joint(problem, model.phi, about_.terms, about_.terms.size()) {
  const auto count = static_cast<Eigen::Index>(columns_of(about_.terms));
  taken_off_mm_ = contribution(about_.point, about_.terms, joint.solution.coefficients.tail(count));
  add(taken_off_mm_, about_.known_mm, -1.0);
  effect_mm = taken_off_mm_;
  if (about_.moved) add(effect_mm, about_.turned_mm);
  widen(given, {});
}

void RelinearisedFit::widen(const Given& given, const Eigen::MatrixXd& between) {
  extended = extended_fit(about_.moved ? *about_.moved : given.stream, given.options, joint,
                          taken_off_mm_, given.masked, between);
}

std::unique_ptr<RelinearisedFit> relinearise(const Given& given, const Problem& whole, Model& model,
                                             std::optional<Timing>& timing) {
  auto best = std::make_unique<RelinearisedFit>(given, whole, model);
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const char* id = other_of(model.terms[t]);
    if (id == nullptr) continue;
    Model other = model;
    other.terms[t] = of_effect(id, {.time_constant_s = 0.0});
    auto rival = std::make_unique<RelinearisedFit>(given, whole, other);
    const auto rows = static_cast<double>(best->joint.equations.count());
    double ratio = rows * std::log(rival->joint.solution.rss / best->joint.solution.rss);
    if (ratio < 0.0) {
      std::swap(best, rival), std::swap(model, other);
      ratio = -ratio;
    }
    timing = {t, ratio};
  }
  return best;
}

}  // namespace trueaxis::diagnose_detail
