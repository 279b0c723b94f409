// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "diagnose/regression/joint.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "diagnose/search/judge.hpp"
#include "diagnose/search/scan.hpp"
#include "diagnose/search/stepwise_search.hpp"
#include "infer/classes.hpp"
#include "infer/fitted.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t most_starts = 6;  // local forms that a search is begun with

Model search_with(StepwiseSearch& engine) {
  bool pattern_was_better = false;
  Model causes = engine.run(false, pattern_was_better);
  if (!pattern_was_better) return causes;
  Model mixed = engine.run(true, pattern_was_better);
  return mixed.criterion < causes.criterion ? std::move(mixed) : std::move(causes);
}

/// The causes of a model, without steps, and all others that have no line and no order to look for,
/// each with all its sizes. There are at least four readings a column.
std::vector<Hypothesis> all_that_may_be(const Problem& problem, const Model& model) {
  std::vector<Hypothesis> out;
  std::ranges::copy_if(model.terms, std::back_inserter(out),
                       [](const Hypothesis& h) { return h.effect && !is_step(h.effect->term); });
  std::size_t columns = problem.point.base.columns() + columns_of(out);
  const auto found = static_cast<std::ptrdiff_t>(out.size());
  for (const Hypothesis& h : preset_causes(problem)) {
    if (is_line(h) || is_step(h.effect->term) || has_free_order(*h.effect)) continue;
    const auto had = std::ranges::find(out, h.effect, &Hypothesis::effect);
    const std::size_t before = had == out.end() ? 0 : had->columns();
    if (had - out.begin() < found || h.columns() <= before ||
        4 * (columns + h.columns() - before) > problem.point.size())
      continue;
    columns += h.columns() - before;
    if (had == out.end())
      out.push_back(h);
    else
      *had = h;
  }
  return out;
}

/// Found step by step from nothing, or by dropping from all that may be. Where several causes are
/// large, each hides the others, and something else takes their place.
Model forward_or_backward(StepwiseSearch& engine, const Problem& problem) {
  Model model = search_with(engine);
  Model left = engine.left_of(all_that_may_be(problem, model), model);
  return engine.unless_noise(left.criterion < model.criterion ? std::move(left) : std::move(model));
}

/// Lobes of every order that few angles show, as far as there are twice as many readings: where
/// several orders are large none of them passes alone.
/// @param growing whether they change along the part
std::vector<Hypothesis> all_lobes(const Problem& problem, bool growing) {
  std::vector<Hypothesis> out;
  std::size_t columns = 2 * problem.point.base.columns();
  for (const Hypothesis& h : preset_causes(problem)) {
    const auto* lobes = std::get_if<Harmonic>(&h.effect->term);
    if (!lobes || lobes->angle != Harmonic::Angle::part ||
        lobes->envelope != Harmonic::Envelope::growing)
      continue;
    const std::size_t phases = h.shape.order == problem.resolution.half_seen ? 1 : 2;
    if (h.columns() != (growing ? 2 * phases : phases)) continue;
    columns += 2 * h.columns();
    if (columns <= problem.point.size()) out.push_back(h);
  }
  return out;
}

std::vector<LobesOfOrder> lobes_by_order(const Problem& problem) {
  std::vector<LobesOfOrder> out;
  for (const bool growing : {false, true})
    for (const Hypothesis& h : all_lobes(problem, growing)) {
      const auto at = std::ranges::find(
          out, h.shape.order, [](const LobesOfOrder& order) { return order.front().shape.order; });
      at == out.end() ? out.push_back({h}) : at->push_back(h);
    }
  return out;
}

/// Puts the likelihood of local forms averaged over all that they might be in the place of that of
/// the best among so many.
void count_shapes(const Problem& problem, Model& model) {
  for (std::size_t t = 0; t < model.terms.size(); ++t)
    if (is_local(model.terms[t]))
      model.criterion +=
          shape_choice(problem, model.phi, model.terms, t) - 2.0 * std::log(model.terms[t].tests);
}

/// What the terms of a model do to X, mm.
std::vector<double> effect_of(const Problem& problem, const Model& model) {
  const Joint joint(problem, model.phi, model.terms, model.terms.size());
  const auto count = static_cast<Eigen::Index>(columns_of(model.terms));
  return contribution(problem.point, model.terms, span_of(joint.solution.coefficients.tail(count)));
}

bool is_bent(const Hypothesis& h) { return h.effect && bends_reading(h.effect->term); }

/// Whether the axis depends on which of two models it is: no lobe moves it.
bool moves_axis(const Model& model) {
  return std::ranges::any_of(model.terms,
                             [](const Hypothesis& h) { return is_local(h) || is_bent(h); });
}

/// The best of models that explain the readings alike, and the others by their probability. What
/// differs by less than one standard deviation is one model (Eq. 82b).
Model best_of(const Problem& problem, std::vector<Model> found) {
  std::ranges::stable_sort(found, {}, &Model::criterion);
  Model& best = found.front();
  const Joint joint(problem, best.phi, best.terms, best.terms.size());
  const double variance = joint.sigma_mm * joint.sigma_mm;
  std::vector<std::vector<double>> had;
  double sum = 0.0;
  for (const Model& model : found) {
    const double likelihood = std::exp(-0.5 * (model.criterion - best.criterion));
    if (likelihood < infer::in_no_class) break;
    if (!had.empty() && !moves_axis(best) && !moves_axis(model)) continue;
    std::vector<double> effect = effect_of(problem, model);
    const auto is_it = [&](const std::vector<double>& other) {
      double sum2 = 0.0;
      for (std::size_t i = 0; i < effect.size(); ++i) sum2 += std::pow(effect[i] - other[i], 2);
      return sum2 < variance;
    };
    if (std::ranges::any_of(had, is_it)) continue;
    if (!had.empty()) best.others.push_back({model.terms, likelihood});
    had.push_back(std::move(effect));
    sum += likelihood;
  }
  for (Otherwise& other : best.others) other.probability /= sum;
  return std::move(best);
}

/// Found step by step from nothing, from lobes of all orders, and from each local form with the
/// lobes that are left after it.
Model search_few_angles(Proposer& proposer, StepwiseSearch& engine) {
  const Problem& problem = proposer.problem();
  std::vector<Model> found{search_with(engine)};
  std::vector<std::vector<Hypothesis>> starts =
      forms_with_lobes(problem, LocalForms(problem), lobes_by_order(problem), most_starts);
  engine.take_local_forms(LocalFormsTaken::none);
  found.push_back(search_with(engine));
  for (const bool growing : {false, true}) starts.push_back(all_lobes(problem, growing));
  engine.take_local_forms(LocalFormsTaken::given);
  bool ignored = false;
  for (std::vector<Hypothesis>& start : starts)
    found.push_back(engine.run(true, ignored, std::move(start)));
  for (Model& model : found) count_shapes(problem, model);
  return best_of(problem, std::move(found));
}

/// Lobes in phase with the eccentricity may be just what a bend makes of it. Their sizes then tell
/// which of both it is, and not that the bend has fewer parameters.
void count_as_bend(const Problem& problem, const Model& bent, Model& straight) {
  const std::size_t named = bent.terms.size();
  std::vector<Hypothesis> all = bent.terms;
  all.insert(all.end(), straight.terms.begin(), straight.terms.end());
  const auto lobes =
      std::find_if(all.begin() + static_cast<long>(named), all.end(),
                   [](const Hypothesis& h) { return h.effect && has_free_order(*h.effect); });
  if (lobes == all.end()) return;
  NormalEquations equations(problem.point, problem.mask, problem.deviation_mm, bent.phi,
                            problem.threads);
  const std::vector<Columns> places = equations.append(all);
  const auto mid = places.begin() + static_cast<long>(named);
  const infer::Fitted in{
      equations.total(), equations.base(), {places.begin(), mid}, equations.count()};
  const Projection left = project(in.gram, infer::besides(in.base, {mid, places.end()}));
  const double variance = left.rss / static_cast<double>(in.count - left.rank);
  double sizes = 0.0;
  Columns bends;
  for (std::size_t t = 0; t < named; ++t) {
    const Hypothesis& bend = bent.terms[t];
    if (!is_bent(bend)) continue;
    bends.insert(bends.end(), places[t].begin(), places[t].end());
    sizes += lobes_over_bend(*lobes, places[static_cast<std::size_t>(lobes - all.begin())], bend,
                             places[t], in.beside(t), in.count);
  }
  if (bends.empty()) {  // only an impossible one
    straight.criterion = std::min(straight.criterion, bent.criterion);
    return;
  }
  const double apart =
      apart_in_phase(infer::besides({}, {mid, places.end()}), bends, project(in.gram, in.base)) /
      variance;
  straight.criterion =
      bent.criterion + counted_as_bend(straight.criterion - bent.criterion, sizes, apart);
}

/// What bends a sensor's readings is weighed against all that may be without it: two lobes that are
/// in phase with the eccentricity look like it, one after the other they never take its place.
Model weighed_without_bend(Model model, const Problem& problem) {
  const bool bent = std::ranges::any_of(model.terms, is_bent) ||
                    (model.impossible && bends_reading(model.impossible->term));
  if (!bent) return model;
  Problem straight = problem;
  std::erase_if(straight.effects, [](const Effect* one) { return bends_reading(one->term); });
  Proposer proposer(straight);
  StepwiseSearch engine(proposer);
  std::vector<Model> found{std::move(model)};
  found.push_back(forward_or_backward(engine, straight));
  count_as_bend(problem, found.front(), found.back());
  return best_of(problem, std::move(found));
}

}  // namespace

Model search(Proposer& proposer) {
  StepwiseSearch engine(proposer);
  const Problem& problem = proposer.problem();
  if (problem.resolution.sparse) return search_few_angles(proposer, engine);
  return weighed_without_bend(forward_or_backward(engine, problem), problem);
}

}  // namespace trueaxis::diagnose_detail
