// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refined.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "trueaxis/math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

const char* other_of(const Hypothesis& h) {
  if (!h.effect) return nullptr;
  return h.effect->id == "probe.lag"       ? "probe.latency"
         : h.effect->id == "probe.latency" ? "probe.lag"
                                           : nullptr;
}

/// By how much the spindle angle of the readings was another than recorded; empty: by nothing.
std::vector<double> turned_by(const std::vector<Hypothesis>& terms, const Scene& recorded,
                              const Eigen::VectorXd& coefficients) {
  std::vector<double> by_rad;
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms) {
    const auto* shift = h.effect ? std::get_if<ArgumentShift>(&h.effect->term) : nullptr;
    if (shift != nullptr && shift->by != ArgumentShift::By::backlash) {  // X is straight in Z
      by_rad.resize(recorded.size(), 0.0);
      for (std::size_t i = 0; i < by_rad.size(); ++i)
        by_rad[i] += shift->by == ArgumentShift::By::delay ? -coefficients(at) * recorded.speed[i]
                                                           : coefficients(at);
    }
    at += static_cast<Eigen::Index>(h.columns());
  }
  return by_rad;
}

void add(std::vector<double>& to, const std::vector<double>& values, double factor = 1.0) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * values[i];
}

/// T ∂X/∂T at T less the integral of ∂X/∂T from 0 to T (Simpson): what a lag's column has too much.
std::vector<double> known_of_lag(const Hypothesis& lag, const Scene& scene) {
  const double T = lag.shape.time_constant_s;
  std::vector<double> out(scene.size(), 0.0);
  for (const auto& [share, weight] :
       {std::pair{0.0, -1.0 / 6.0}, {0.5, -4.0 / 6.0}, {1.0, 5.0 / 6.0}}) {
    Hypothesis at = lag;
    at.shape.time_constant_s = share * T;
    add(out, contribution(scene, {at}, Eigen::VectorXd::Constant(1, T)), weight);
  }
  return out;
}

About about(const Given& given, const Problem& whole, const Model& model) {
  const Scene& first = whole.scene;
  const Joint near(whole, model.phi, model.terms, model.terms.size());
  const auto count = static_cast<Eigen::Index>(columns_of(model.terms));
  const Eigen::VectorXd found = near.solution.coefficients.tail(count);
  const FitResult extended = extended_fit(given.stream, given.options, near,
                                          contribution(first, model.terms, found), given.masked);
  About out;
  out.terms = model.terms;
  const bool again = is_diagnosable(extended) && !model.terms.empty();
  const auto scene_of = [&](const ProbeStream& stream) {
    return make_scene(stream, clampings_of(extended, given.ball_mm), first.base, first.bore);
  };
  if (!again) {
    out.scene = first;
    out.known_mm.assign(first.size(), 0.0);
    out.deviation_mm = deviation_from(given.stream, first);
    return out;
  }
  const std::vector<double> by_rad = turned_by(model.terms, first, found);
  if (!by_rad.empty()) {
    out.moved = given.stream;
    add(out.moved->c_rad, by_rad);
  }
  out.scene = scene_of(out.moved ? *out.moved : given.stream);
  out.known_mm.assign(out.scene.size(), 0.0);
  // X(a) = X(a') + (a − a') ∂X/∂a.
  for (std::size_t i = 0; i < by_rad.size(); ++i) out.known_mm[i] = by_rad[i] * out.scene.dx_dc[i];
  Eigen::Index at = 0;
  for (Hypothesis& h : out.terms) {
    if (h.effect && h.effect->id == "probe.lag") {
      h.shape.time_constant_s = std::max(0.0, found(at));
      add(out.known_mm, known_of_lag(h, out.scene));
    }
    at += static_cast<Eigen::Index>(h.columns());
  }
  out.deviation_mm = deviation_from(given.stream, out.scene);
  add(out.deviation_mm, out.known_mm);
  if (!by_rad.empty()) {
    out.turned_mm = out.scene.x;
    add(out.turned_mm, scene_of(given.stream).x, -1.0);
  }
  return out;
}

}  // namespace

std::vector<double> deviation_from(const ProbeStream& stream, const Scene& scene) {
  std::vector<double> out(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) out[i] = stream.reading_mm[i] - scene.x[i];
  if (!scene.base.offset) return out;
  const double zero = median(out);
  for (double& d : out) d -= zero;
  return out;
}

Refined::Refined(const Given& given, const Problem& whole, const Model& model)
    : about_(about(given, whole, model)),
      problem{about_.scene,      whole.rows,    whole.resolution, about_.deviation_mm,
              whole.false_alarm, whole.threads, whole.most_terms},
      joint(problem, model.phi, about_.terms, about_.terms.size()) {
  const auto count = static_cast<Eigen::Index>(columns_of(about_.terms));
  effect_mm = contribution(about_.scene, about_.terms, joint.solution.coefficients.tail(count));
  add(effect_mm, about_.known_mm, -1.0);
  extended = extended_fit(about_.moved ? *about_.moved : given.stream, given.options, joint,
                          effect_mm, given.masked);
  if (about_.moved) add(effect_mm, about_.turned_mm);
}

std::unique_ptr<Refined> refine_model(const Given& given, const Problem& whole, Model& model,
                                      std::optional<Timing>& timing) {
  auto best = std::make_unique<Refined>(given, whole, model);
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const char* id = other_of(model.terms[t]);
    if (id == nullptr) continue;
    Model other = model;
    other.terms[t] = of_effect(id, {.time_constant_s = 0.0});
    auto rival = std::make_unique<Refined>(given, whole, other);
    const auto rows = static_cast<double>(best->joint.evidence.count());
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
