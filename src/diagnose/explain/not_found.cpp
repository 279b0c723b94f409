// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/not_found.hpp"

#include <algorithm>
#include <cmath>

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

namespace {

bool is(Response::Of of, const Effect& effect) {
  const auto* response = std::get_if<Response>(&effect.term);
  return response && response->of == of;
}

}  // namespace

std::optional<Hypothesis> slope_beside(const Problem& problem,
                                       const std::vector<Hypothesis>& terms) {
  const auto is_found = [&](const Hypothesis& h) {
    return h.effect && is(Response::Of::gain, *h.effect);
  };
  const auto gain = std::ranges::find_if(
      problem.effects, [](const Effect* effect) { return is(Response::Of::gain, *effect); });
  if (gain == problem.effects.end() || (*gain)->stated || std::ranges::any_of(terms, is_found))
    return {};
  return of_effect(**gain, typical_shape(**gain, problem.point));
}

bool bends_about_a_place(const Hypothesis& h) {
  return h.effect && is(Response::Of::nonlinearity, *h.effect);
}

SizePrior slope_prior(const Hypothesis& bend, const Weighed& size) {
  // c₂v² about a place r of the range read has the slope −2c₂r in the middle; r is anywhere in
  // (−1, 1), r² is 1/3 in the mean. c₃v³ alone has its place near the middle, and −3c₃r² with
  // 3c₃r as large as c₃.
  const auto names = linear_parameters(bend.effect->term, bend.shape);
  double variance = 0.0;
  for (Eigen::Index j = 0; j < size.mean.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const bool square = names[bend.free.empty() ? k : bend.free[k]].name == "quadratic";
    const double size2 = size.mean(j) * size.mean(j) + size.covariance(j, j);
    variance += (square ? 4.0 : 1.0) / 3.0 * size2;
  }
  SizePrior out;
  out.median = Eigen::VectorXd::Ones(1);
  out.stated = std::sqrt(variance) / bend.shape.range_mm, out.doubt = 0.0;
  return out;
}

}  // namespace trueaxis::diagnose_detail
