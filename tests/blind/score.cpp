// SPDX-License-Identifier: Apache-2.0
#include "blind/score.hpp"

#include <algorithm>

#include "blind/goals.hpp"
#include "blind/rival.hpp"

namespace trueaxis::blind {
namespace {

bool holds(const std::vector<std::string>& list, const std::string& id) {
  return std::ranges::find(list, id) != list.end();
}

// Kuhn's augmenting path from truth i.
bool place(std::size_t i, const std::vector<Effect>& truths,
           const std::vector<std::vector<std::string>>& classes, std::vector<bool>& seen,
           std::vector<int>& truth_of) {
  for (std::size_t j = 0; j < classes.size(); ++j) {
    if (seen[j] || !holds(classes[j], truths[i].id)) continue;
    seen[j] = true;
    const bool free = truth_of[j] < 0 ||
                      place(static_cast<std::size_t>(truth_of[j]), truths, classes, seen, truth_of);
    if (!free) continue;
    truth_of[j] = static_cast<int>(i);
    return true;
  }
  return false;
}

void measure_members(const BlindCase& blind_case, const Sealed& truth, std::size_t i,
                     const std::vector<std::string>& members, Score& out) {
  TrueEffect one{truth.effects[i], truth.effects, truth.sigma_mm};
  one.others.erase(one.others.begin() + static_cast<std::ptrdiff_t>(i));
  for (const std::string& id : members) {
    if (id == one.effect.id) continue;
    const double d = distance(*blind_case.bench, one, id, demanded_distance);
    out.members.push_back({id, d});
    if (!(d < demanded_distance)) out.strict = false;
  }
}

Outcome judge_names(const BlindCase& blind_case, const Sealed& truth, const Answer& answer,
                    Score& out) {
  const std::vector<int> finding_of = pair_up(truth.effects, answer.classes);
  std::size_t placed = 0;
  std::vector<bool> used(answer.classes.size(), false);
  for (const int j : finding_of) {
    if (j >= 0) ++placed, used[static_cast<std::size_t>(j)] = true;
  }
  const std::size_t left_over = answer.classes.size() - placed + answer.unexplained.size();
  auto stray = std::ranges::find(used, false);
  for (std::size_t i = 0; i < finding_of.size(); ++i) {
    if (finding_of[i] >= 0) {
      const auto& members = answer.classes[static_cast<std::size_t>(finding_of[i])];
      out.named.push_back(members.front());
      measure_members(blind_case, truth, i, members, out);
    } else if (stray != used.end()) {
      out.named.push_back(answer.classes[static_cast<std::size_t>(stray - used.begin())].front());
      stray = std::find(stray + 1, used.end(), false);
    } else {
      out.named.emplace_back(answer.unexplained.empty() ? "nothing" : "unexplained");
    }
  }
  const bool all = placed == truth.effects.size();
  if (!all) return left_over > 0 ? Outcome::wrong_name : Outcome::missed;
  if (left_over > 0) return Outcome::extra_finding;
  const auto excluded = [](const Member& member) { return !(member.distance < allowed_distance); };
  return std::ranges::any_of(out.members, excluded) ? Outcome::too_wide : Outcome::correct;
}

constexpr const char* outcome_names[] = {
    "correct",     "too wide",           "wrong name",    "missed", "false alarm",
    "extra cause", "not called unknown", "not abstained", "crash"};

}  // namespace

std::string to_string(Outcome outcome) { return outcome_names[static_cast<int>(outcome)]; }

std::vector<Outcome> all_outcomes() {
  std::vector<Outcome> list;
  for (int i = 0; i <= static_cast<int>(Outcome::crash); ++i)
    list.push_back(static_cast<Outcome>(i));
  return list;
}

std::vector<int> pair_up(const std::vector<Effect>& truths,
                         const std::vector<std::vector<std::string>>& classes) {
  std::vector<int> truth_of(classes.size(), -1), finding_of(truths.size(), -1);
  for (std::size_t i = 0; i < truths.size(); ++i) {
    std::vector<bool> seen(classes.size(), false);
    place(i, truths, classes, seen, truth_of);
  }
  for (std::size_t j = 0; j < classes.size(); ++j) {
    if (truth_of[j] >= 0) finding_of[static_cast<std::size_t>(truth_of[j])] = static_cast<int>(j);
  }
  return finding_of;
}

Score score(const BlindCase& blind_case, const Sealed& truth, const Answer& answer) {
  Score out;
  if (answer.broken()) {
    out.named.assign(truth.effects.size(), "crash");
    return out;
  }
  const bool silent = answer.classes.empty() && answer.unexplained.empty();
  const std::string first = !answer.classes.empty()       ? answer.classes.front().front()
                            : !answer.unexplained.empty() ? "unexplained"
                                                          : "nothing";
  switch (truth.kind) {
    case Kind::null:
      out.outcome = silent ? Outcome::correct : Outcome::false_alarm;
      out.named = {first};
      break;
    case Kind::unknown:
      out.outcome =
          answer.classes.empty() && !silent ? Outcome::correct : Outcome::not_called_unknown;
      out.named = {first};
      break;
    case Kind::absorbed:
      out.outcome = silent && answer.not_observable.contains(truth.effects.front().id)
                        ? Outcome::correct
                        : Outcome::not_abstained;
      out.named = {silent && out.outcome == Outcome::correct ? "not observable" : first};
      break;
    case Kind::one:
    case Kind::two:
    case Kind::three:
    case Kind::gaps:
    case Kind::typical:
      out.outcome = judge_names(blind_case, truth, answer, out);
      break;
  }
  return out;
}

}  // namespace trueaxis::blind
