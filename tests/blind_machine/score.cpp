// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "blind_machine/study.hpp"

namespace trueaxis::blind_machine {
namespace {

constexpr double allowed_distance = 6.6;  // Φ(d/2) = 0.9995: no data leave that open

bool holds(const std::vector<std::string>& members, const std::string& name) {
  return std::ranges::find(members, name) != members.end();
}

/// Which cause belongs to which of at most two truths, the best of both ways round.
std::vector<int> paired(const std::vector<std::string>& truth,
                        const std::vector<std::vector<std::string>>& classes) {
  std::vector<int> best(truth.size(), -1);
  std::size_t most = 0;
  const int count = static_cast<int>(classes.size());
  const auto fits = [&](int finding, std::size_t t) {
    return finding >= 0 && holds(classes[static_cast<std::size_t>(finding)], truth[t]);
  };
  for (int a = -1; a < count; ++a)
    for (int b = -1; b < (truth.size() > 1 ? count : 0); ++b) {
      if (a == b && a >= 0) continue;
      std::vector<int> now{fits(a, 0) ? a : -1};
      if (truth.size() > 1) now.push_back(fits(b, 1) ? b : -1);
      const auto placed =
          static_cast<std::size_t>(std::ranges::count_if(now, [](int i) { return i >= 0; }));
      if (placed > most) most = placed, best = now;
    }
  return best;
}

/// The columns of the true terms but one: who names that one has to estimate them as well.
Eigen::MatrixXd columns_of_others(const Judge& judge, const Case& one, std::size_t but) {
  Eigen::MatrixXd all;
  for (std::size_t t = 0; t < one.truth.size(); ++t) {
    if (t == but) continue;
    const std::size_t slip = one.hidden[t].units.front().slip_at;
    const Eigen::MatrixXd own =
        slip > 0 ? judge.slip_columns(slip - 1) : judge.columns(judge.index(one.truth[t]));
    all.conservativeResize(own.rows(), all.cols() + own.cols());
    all.rightCols(own.cols()) = own;
  }
  return all;
}

Outcome of_names(const Case& one, const Answer& answer, Members& members) {
  const std::vector<int> finding = paired(one.truth, answer.classes);
  std::size_t placed = 0;
  std::optional<Judge> judge;
  for (std::size_t t = 0; t < one.truth.size(); ++t) {
    if (finding[t] < 0) continue;
    ++placed;
    for (const std::string& member : answer.classes[static_cast<std::size_t>(finding[t])]) {
      if (member == one.truth[t]) continue;
      if (!judge) judge.emplace(one.layout->machine, one.plan);
      ++members.listed;
      const Eigen::VectorXd mu = judge->effect_of(one.hidden[t].units.front());
      const Eigen::MatrixXd others = columns_of_others(*judge, one, t);
      if (!(judge->distance(mu, member, others) < allowed_distance)) ++members.far;
      if (!(judge->distance(mu, member) < allowed_distance)) ++members.far_alone;
    }
  }
  const std::size_t more = answer.classes.size() + answer.unexplained.size() - placed;
  if (placed < one.truth.size()) return more > 0 ? Outcome::wrong_name : Outcome::missed;
  if (more > 0) return Outcome::extra_finding;
  return members.far > 0 ? Outcome::too_wide : Outcome::correct;
}

}  // namespace

Outcome score(const Case& one, const Answer& answer, Members& members) {
  if (answer.exit_code != 0) return Outcome::crash;
  const bool silent = answer.classes.empty() && answer.unexplained.empty();
  switch (one.wanted.kind) {
    case Kind::silent:
      return silent ? Outcome::correct : Outcome::false_alarm;
    case Kind::unknown:
      return answer.classes.empty() && !silent ? Outcome::correct : Outcome::not_called_unknown;
    case Kind::absorbed:
      if (one.truth.empty()) return silent ? Outcome::correct : Outcome::false_alarm;
      return silent && answer.not_observable.contains(one.truth.front()) ? Outcome::correct
                                                                         : Outcome::not_abstained;
    case Kind::one:
    case Kind::two:
    case Kind::advised:
      break;
  }
  return of_names(one, answer, members);
}

}  // namespace trueaxis::blind_machine
