// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "blind/score.hpp"

namespace trueaxis::blind {

/// One case of a study with all that was found out about it.
struct Result {
  BlindCase made;
  Answer answer;
  Score score;
  /// An advice that was followed: the measurement, and what the command said with it.
  std::string advice;
  bool advice_wanted = false, advice_taken = false, advice_resolved = false;
  Answer advised;  ///< with the measurement added
};

struct StudyOptions {
  std::string command;            ///< the trueaxis command; empty: the library
  std::filesystem::path scratch;  ///< streams and truths, case by case
  bool keep = false;              ///< leave them there
  bool follow_advice = false;     ///< take the next measurement of every case with one cause
  int jobs = 2;
  /// Called after every case, under a lock.
  std::function<void(std::size_t done, const Result&)> progress;
};

/// Which cases a study has: kinds × plans × surfaces in turn, until `cases`.
struct Selection {
  std::vector<Kind> kinds = all_kinds();
  std::vector<PlanId> plans = all_plans();
  std::vector<SurfaceId> surfaces{SurfaceId::cone, SurfaceId::cylinder};
  std::size_t cases = 1000;
  std::uint64_t seed = 1;
};

/// Seeds and kinds of the cases: number i depends on the seed and i alone.
std::vector<Wanted> select(const Selection& selection);

/// Makes the case, seals its truth, runs the command, opens the truth and scores.
Result run_case(const Wanted& wanted, const StudyOptions& options);

/// All of them, `jobs` at a time; the order of the results is that of `wanted`.
std::vector<Result> run_study(const std::vector<Wanted>& wanted, const StudyOptions& options);

}  // namespace trueaxis::blind
