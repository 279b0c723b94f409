// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "diagnose/refit/places_before.hpp"
#include "diagnose/refit/relinearised_fit.hpp"
#include "diagnose/refit/timing.hpp"
#include "diagnose/regression/size_prior.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// The fit without terms whose test does not pass about what was found, the least of them first.
/// What a lag leaves of a delay in the second order looks like a slip where the speed changes,
/// until the lag is a delay.
std::unique_ptr<RelinearisedFit> fit_of_what_passes(const IdealModel& ideal, Model& model) {
  for (;;) {
    auto made = std::make_unique<RelinearisedFit>(ideal, model);
    if (model.terms.size() < 2) return made;
    const Joint& joint = made->joint();
    const infer::Fitted in{joint.equations.total(), joint.equations.base(), joint.places,
                           joint.equations.count()};
    std::vector<double> log_p;
    for (std::size_t t = 0; t < model.terms.size(); ++t) log_p.push_back(in.log_p(t));
    const auto least = std::ranges::max_element(log_p);
    if (model.family.p_value(std::exp(*least)) < ideal.problem.false_alarm) return made;
    const auto at = least - log_p.begin();
    model.terms.erase(model.terms.begin() + at);
    model.p_values.erase(model.p_values.begin() + at);
  }
}

/// With the shape of every term refined about the part together with the others, if that is better:
/// the search had them about the ideal fit, and with a delay of 35 ms a length of decay 5 % off.
std::unique_ptr<RelinearisedFit> with_shapes_refined(const IdealModel& ideal, Model& model,
                                                     std::unique_ptr<RelinearisedFit> fit) {
  if (is_condensed(ideal.problem.point)) return fit;  // so many readings cost too much
  Model other = model;
  std::vector<Hypothesis> terms = fit->joint().terms;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (is_linearised_at_its_size(terms[t])) continue;
    std::vector<Hypothesis> others = terms;
    others.erase(others.begin() + static_cast<long>(t));
    terms[t] = refine(fit->problem(), model.phi, others, terms[t], step_start);
    other.terms[t] = terms[t];
  }
  auto refined = fit_of_what_passes(ideal, other);
  if (!(refined->criterion() < fit->criterion())) return fit;
  model = std::move(other);
  return refined;
}

}  // namespace

std::vector<std::unique_ptr<RelinearisedFit>> about_what_moves(const IdealModel& ideal,
                                                               const Model& model,
                                                               const RelinearisedFit& fit) {
  const Joint first(ideal.problem, model.phi, model.terms, model.terms.size());
  const double a_term = std::log(static_cast<double>(first.equations.count()));
  const bool bends = std::abs(criterion_of(first) - fit.criterion()) > a_term;
  std::vector<Hypothesis> steps, probe;
  for (const Hypothesis& h : model.terms) {
    if (is_slip(h) && steps.empty()) steps.push_back(h);
    if (bends && moves_probe(h)) probe.push_back(h);
  }
  std::vector<std::unique_ptr<RelinearisedFit>> out;
  for (std::vector<Hypothesis>* some : {&steps, &probe}) {
    if (some->empty()) continue;
    Model alone = model;
    alone.terms = std::move(*some);
    out.push_back(std::make_unique<RelinearisedFit>(ideal, alone));
  }
  return out;
}

std::unique_ptr<RelinearisedFit> relinearise(const IdealModel& ideal, Model& model,
                                             std::optional<Timing>& timing) {
  auto best = with_shapes_refined(ideal, model, fit_of_what_passes(ideal, model));
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Effect* effect = model.terms[t].effect;
    if (!effect || effect->second_order_twin.empty()) continue;
    Model other = model;
    const auto twin =
        std::ranges::find(ideal.problem.effects, effect->second_order_twin, &Effect::id);
    expects(twin != ideal.problem.effects.end(), "a twin is a cause of the same streams");
    other.terms[t] = of_effect(**twin, {.time_constant_s = 0.0});
    auto rival = fit_of_what_passes(ideal, other);
    const auto its = static_cast<std::size_t>(
        std::ranges::find(other.terms, *twin, &Hypothesis::effect) - other.terms.begin());
    if (its == other.terms.size() || !size_prior(other.terms[its]).allows(rival->joint().of(its)))
      continue;  // a lag that leads
    const auto rows = static_cast<double>(best->joint().equations.count());
    double ratio = rows * std::log(rival->joint().solution.rss / best->joint().solution.rss);
    if (ratio < 0.0) {
      std::swap(best, rival), std::swap(model, other);
      ratio = -ratio, t = its;
    }
    timing = {t, ratio};
  }
  return best;
}

}  // namespace trueaxis::diagnose_detail
