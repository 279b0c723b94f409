// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/search.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/causes.hpp"
#include "diagnose/search/stepwise_search.hpp"

namespace trueaxis::diagnose_detail {
namespace {

Model search_with(StepwiseSearch& engine) {
  bool pattern_was_better = false;
  Model causes = engine.run(false, pattern_was_better);
  if (!pattern_was_better) return causes;
  Model mixed = engine.run(true, pattern_was_better);
  return mixed.criterion < causes.criterion ? mixed : causes;
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

/// The best model of few angles that has a local form: found step by step, begun with one, or with
/// one beside what is found without, or beside all lobes.
Model with_local_form(Proposer& proposer, StepwiseSearch& engine, const Model& without) {
  Model best = search_with(engine);
  for (const std::vector<Hypothesis>& beside :
       {std::vector<Hypothesis>{}, without.terms, all_lobes(proposer.problem(), false)}) {
    const Proposal& p = proposer.beside(beside, best.phi);
    const auto form = std::ranges::find_if(
        p.patterns, [](const Candidate& c) { return is_local(c.hypothesis) && c.rank > 0; });
    if (form == p.patterns.end()) continue;
    std::vector<Hypothesis> first = beside;
    first.push_back(form->hypothesis);
    bool ignored = false;
    Model model = engine.run(true, ignored, std::move(first));
    if (model.criterion < best.criterion) best = std::move(model);
  }
  return best;
}

}  // namespace

Model search(Proposer& proposer) {
  StepwiseSearch engine(proposer);
  if (!proposer.problem().resolution.sparse) return search_with(engine);
  engine.take_local_forms(false);
  Model without = search_with(engine);
  bool ignored = false;
  for (const bool growing : {false, true}) {
    Model model = engine.run(true, ignored, all_lobes(proposer.problem(), growing));
    if (model.criterion < without.criterion) without = std::move(model);
  }
  engine.take_local_forms(true);
  Model with = with_local_form(proposer, engine, without);
  const auto has_local = [](const Model& m) { return std::ranges::any_of(m.terms, is_local); };
  if (!has_local(with)) return without;
  if (without.criterion < with.criterion) std::swap(with, without);
  const double odds = std::exp(0.5 * (without.criterion - with.criterion));
  with.otherwise = Otherwise{without.terms, 1.0 / (1.0 + odds)};
  return with;
}

}  // namespace trueaxis::diagnose_detail
