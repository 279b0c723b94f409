// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "blind/goals.hpp"
#include "blind/study.hpp"

namespace trueaxis::blind {

/// Cases of one kind and plan, or of one noise: how many came out how.
struct Cell {
  std::size_t cases = 0;
  std::map<Outcome, std::size_t> outcomes;
  double goal_share = 0.0;

  std::size_t right() const {
    const auto found = outcomes.find(Outcome::correct);
    return found == outcomes.end() ? 0 : found->second;
  }
};

struct Tally {
  std::map<std::pair<Kind, PlanId>, Cell> cells;
  std::map<Kind, Cell> kinds;          ///< over the plans; the goal is that of P3
  std::map<std::string, Cell> noises;  ///< of the null cases
  std::map<std::string, std::map<std::string, std::size_t>> confusion;  ///< truth → named → count
  std::size_t members = 0, members_strict = 0;  ///< listed rival causes; those with d < 3.29
  std::size_t members_excluded = 0;             ///< those with d ≥ 6.6
  /// For members of classes that hold a truth, by their stated probability in tenths: their number,
  /// the sum of the probabilities, and how many are the truth.
  struct Stated {
    std::size_t members = 0, true_ones = 0;
    double sum = 0.0;
  };
  std::array<Stated, 10> reliability{};
  std::size_t advice_wanted = 0, advice_taken = 0, advice_resolved = 0;
  std::map<std::string, std::pair<std::size_t, std::size_t>> advice;  ///< plan → taken, resolved
  double seconds = 0.0;                                               ///< of the command, all cases
  std::size_t cases = 0;
};

Tally tally(const std::vector<Result>& results);

/// Tables for a terminal.
std::string text_of(const Tally& tally);
nlohmann::json json_of(const Tally& tally);

/// Truth × named, a header row first.
std::string confusion_csv(const Tally& tally);

/// A case that did not come out right, in one line with what makes it again.
std::string line_of(const Result& result);

}  // namespace trueaxis::blind
