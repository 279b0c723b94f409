// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/searched.hpp"

#include <algorithm>
#include <utility>

#include "diagnose/refit/places_before.hpp"

namespace trueaxis::diagnose_detail {
namespace {

Searched searched_in(const Problem& problem, const IdealModel& ideal) {
  Searched out;
  out.search = std::make_unique<CoarseToFineSearch>(problem);
  out.fit = relinearise(ideal, out.search->model, out.timing);
  out.moved = about_what_moves(ideal, out.search->model, *out.fit);
  out.about = &problem;
  for (const auto& part : out.moved) {
    auto search = std::make_unique<CoarseToFineSearch>(part->problem());
    std::optional<Timing> timing;
    auto fit = relinearise(ideal, search->model, timing);
    if (!(fit->criterion() < out.fit->criterion())) continue;
    out.search = std::move(search), out.fit = std::move(fit), out.timing = timing;
    out.about = &part->problem();
  }
  return out;
}

}  // namespace

Searched searched(const IdealModel& ideal) {
  Searched best = searched_in(ideal.problem, ideal);
  const std::vector<Hypothesis>& terms = best.search->model.terms;
  if (std::ranges::none_of(terms, is_slip)) return best;
  Problem at_rest = ideal.problem;
  std::erase_if(at_rest.effects, [](const Effect* effect) { return is_step(effect->term); });
  at_rest.most_terms = std::min(at_rest.most_terms, terms.size() + 1);  // more are not simpler
  Searched other = searched_in(at_rest, ideal);
  const std::vector<Hypothesis>& instead = other.search->model.terms;
  const bool a_cause = std::ranges::any_of(instead, moves_probe) ||
                       std::ranges::count(instead, nullptr, &Hypothesis::effect) <=
                           std::ranges::count(terms, nullptr, &Hypothesis::effect);
  if (!a_cause || !(other.fit->criterion() < best.fit->criterion())) {
    best.at_rest_mm = other.fit->residual_mm();
    return best;
  }
  if (other.about == &at_rest) other.search->about(*(other.about = &ideal.problem));
  return other;
}

}  // namespace trueaxis::diagnose_detail
