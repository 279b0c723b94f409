// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/not_found.hpp"

#include <algorithm>

#include "diagnose/search/causes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// A step that was found in some of its parameters had the others too: what of them the readings do
/// not show enters U.
void add_rest_of_steps(const Problem& problem, const std::vector<Hypothesis>& terms,
                       std::vector<Hypothesis>& list) {
  for (const Hypothesis& step : terms) {
    if (!step.effect || step.free.empty() || !is_step(step.effect->term)) continue;
    std::vector<SearchForm> forms = step.effect->search.forms;
    SearchForm all{.degrees = 1};  // but for a turn, which is a shift of where the part is
    const auto parameters = linear_parameters(step.effect->term, step.shape);
    for (std::size_t j = 0; j < parameters.size(); ++j)
      if (parameters[j].name != "turn") all.free.push_back(j);
    forms.push_back(std::move(all));
    for (const SearchForm& form : forms) {
      if (problem.resolution.degrees < form.degrees) continue;
      Hypothesis rest = step;
      rest.free.clear();
      rest.tests = 1.0;  // its date is known
      for (const std::size_t j : form.free)
        if (std::ranges::find(step.free, j) == step.free.end()) rest.free.push_back(j);
      if (!rest.free.empty()) list.push_back(std::move(rest));
    }
  }
}

}  // namespace

std::vector<Hypothesis> not_found(const Problem& problem, const std::vector<Hypothesis>& terms,
                                  const std::vector<AmbiguousFinding>& findings) {
  std::vector<Hypothesis> list = preset_causes(problem);
  std::erase_if(list, [&](const Hypothesis& h) {
    const Effect& effect = *h.effect;
    const auto is_it = [&](const Hypothesis& other) { return other.effect == &effect; };
    if (has_free_order(effect) || is_step(effect.term) || effect.same_in_cut ||
        std::ranges::any_of(terms, is_it))
      return true;
    if (effect.stated) return effect.stated->u == 0.0;
    return std::ranges::any_of(findings, [&](const AmbiguousFinding& f) {
      return std::ranges::any_of(f.found.members,
                                 [&](const Candidate& c) { return is_it(c.hypothesis); });
    });
  });
  add_rest_of_steps(problem, terms, list);
  return list;
}

}  // namespace trueaxis::diagnose_detail
