// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/searched.hpp"

#include <algorithm>
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

Searched searched_in(const Problem& problem, const IdealModel& ideal) {
  Searched out;
  bool dropped = false;
  const auto search_about = [&](const Problem& about) {
    auto search = std::make_unique<CoarseToFineSearch>(about);
    const std::size_t found = search->model.terms.size();
    std::optional<Timing> timing;
    auto fit = relinearise(ideal, search->model, timing);
    if (out.fit && !(fit->criterion() < out.fit->criterion())) return;
    dropped = search->model.terms.size() < found;
    out.search = std::move(search), out.fit = std::move(fit), out.timing = timing;
    out.about = &about;
  };
  search_about(problem);
  // If the fit dropped terms, what was searched about was not near enough.
  for (int round = 0; round < most_searches && (round == 0 || dropped); ++round) {
    dropped = false;
    for (auto& part : about_what_moves(ideal, out.search->model, *out.fit)) {
      out.moved.push_back(std::move(part));
      search_about(out.moved.back()->problem());
    }
  }
  return out;
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
  without.fewest_cycles = cycles_of_a_line;
  const auto slow = [&](const Hypothesis& h) { return is_slow_line(without, h); };
  if (std::ranges::any_of(best.search->model.terms, slow)) weigh_against(without, ideal, best);
  return best;
}

}  // namespace trueaxis::diagnose_detail
