// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/searched.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "diagnose/refit/places_before.hpp"
#include "diagnose/refit/timing.hpp"
#include "diagnose/search/scan.hpp"
#include "diagnose/search/scan_list.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr int most_searches = 2;          // about what moves
constexpr double cycles_of_a_line = 2.0;  // nearer to one per revolution a bend looks like it

bool is_late(const Hypothesis& h) { return is_lag(h) || is_delay(h); }

bool is_slow_line(const Problem& problem, const Hypothesis& h) {
  if (!h.effect || !h.effect->line) return false;
  const Extent slow = slow_lines(problem, h.effect->line->in);
  return frequency_of(h) > slow.low && frequency_of(h) < slow.high;
}

/// Searches about a part, and keeps what is found if it is better.
void search_about(const Problem& about, const IdealModel& ideal, Searched& best) {
  auto search = std::make_unique<CoarseToFineSearch>(about);
  const std::size_t found = search->model.terms.size();
  std::optional<Timing> timing;
  auto fit = relinearise(ideal, search->model, timing);
  if (best.fit && !(fit->criterion() < best.fit->criterion())) return;
  best.dropped = search->model.terms.size() < found;
  best.search = std::move(search), best.fit = std::move(fit), best.timing = timing;
  best.about = &about;
}

Searched searched_in(const Problem& problem, const IdealModel& ideal) {
  Searched out;
  search_about(problem, ideal, out);
  for (int round = 0; round < most_searches && (round == 0 || out.dropped); ++round) {
    out.dropped = false;
    for (auto& part : about_what_moves(ideal, out.search->model, *out.fit)) {
      out.moved.push_back(std::move(part));
      search_about(out.moved.back()->problem(), ideal, out);
    }
  }
  return out;
}

/// Whether a term may be what a play leaves of the eccentricity and of other waves.
bool may_be_of_play(const Hypothesis& h) {
  const auto* wave = h.effect ? std::get_if<Harmonic>(&h.effect->term) : nullptr;
  return !h.effect || (wave && std::max(wave->fixed_order, h.shape.order) >= 2.0);
}

/// Those terms of a fit, the largest first.
std::vector<Hypothesis> waves_of(const Joint& joint) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < joint.terms.size(); ++t) {
    if (!may_be_of_play(joint.terms[t])) continue;
    const std::vector<double> x_mm = joint.contribution_of(t);
    order.emplace_back(std::inner_product(x_mm.begin(), x_mm.end(), x_mm.begin(), 0.0), t);
  }
  std::ranges::stable_sort(order, std::ranges::greater{}, &std::pair<double, std::size_t>::first);
  std::vector<Hypothesis> out;
  for (const auto& [size, t] : order) out.push_back(joint.terms[t]);
  return out;
}

/// A play is about the way of X with all its waves, which no search about the ideal part knows.
/// Waves are added one by one while they are worth it: those found without a play are partly its.
/// A display that rounds holds its readings as a play does.
void try_play(const IdealModel& ideal, Searched& best) {
  const auto is_play = [](const Effect* effect) { return plays(of_effect(*effect, {})); };
  const auto play = std::ranges::find_if(ideal.problem.effects, is_play);
  Model with = best.search->model;
  if (with.terms.empty() || play == ideal.problem.effects.end() ||
      is_condensed(ideal.problem.point) || ideal.problem.rounding_mm > 0.0)
    return;
  std::erase_if(with.terms, [](const Hypothesis& h) { return plays(h) || may_be_of_play(h); });
  with.terms.push_back(of_effect(**play, {}));
  const auto fitted = [&] {
    with.p_values.assign(with.terms.size(), 0.0);
    return std::make_unique<RelinearisedFit>(ideal, with);
  };
  auto fit = fitted();
  for (Hypothesis& wave : waves_of(best.fit->joint())) {
    with.terms.push_back(std::move(wave));
    auto next = fitted();
    if (!(next->criterion() < fit->criterion())) break;
    fit = std::move(next);
  }
  if (fit->criterion() > best.fit->criterion()) return;
  best.moved.push_back(std::move(fit));
  search_about(best.moved.back()->problem(), ideal, best);
}

/// Takes the model of a search that leaves something out, if it is the better: more terms are not
/// simpler, and neither are patterns that have no cause.
/// @returns what that model leaves of the readings, if it is not the better
std::vector<double> weigh_against(Problem without, const IdealModel& ideal, Searched& best) {
  const std::vector<Hypothesis>& terms = best.search->model.terms;
  without.most_terms = std::min(without.most_terms, terms.size() + 1);
  Searched other = searched_in(without, ideal);
  const std::vector<Hypothesis>& instead = other.search->model.terms;
  const bool a_cause = std::ranges::any_of(instead, moves_probe) ||
                       std::ranges::count(instead, nullptr, &Hypothesis::effect) <=
                           std::ranges::count(terms, nullptr, &Hypothesis::effect);
  if (!a_cause || !(other.fit->criterion() < best.fit->criterion()))
    return other.fit->residual_mm();
  if (other.about == &without) other.search->about(*(other.about = &ideal.problem));
  best = std::move(other);
  return {};
}

}  // namespace

Searched searched(const IdealModel& ideal) {
  Searched best = searched_in(ideal.problem, ideal);
  Problem without = ideal.problem;
  if (std::ranges::any_of(best.search->model.terms, is_slip)) {
    std::erase_if(without.effects, [](const Effect* effect) { return is_step(effect->term); });
    best.at_rest_mm = weigh_against(without, ideal, best);
    if (!best.at_rest_mm.empty()) without.effects = ideal.problem.effects;
  }
  // A long delay turns farther than a column reaches, and then looks like two lags.
  if (std::ranges::count_if(best.search->model.terms, is_late) > 1) {
    Problem no_lag = ideal.problem;
    std::erase_if(no_lag.effects,
                  [](const Effect* effect) { return is_lag(of_effect(*effect, {})); });
    weigh_against(no_lag, ideal, best);
  }
  try_play(ideal, best);
  without.fewest_cycles = cycles_of_a_line;
  const auto slow = [&](const Hypothesis& h) { return is_slow_line(without, h); };
  if (std::ranges::any_of(best.search->model.terms, slow)) weigh_against(without, ideal, best);
  return best;
}

}  // namespace trueaxis::diagnose_detail
