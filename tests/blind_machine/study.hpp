// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "blind_machine/cases.hpp"

namespace trueaxis::blind_machine {

/// The next measurement as the command gives it: code, and visits of balls with tools.
struct Advice {
  std::string code;
  std::vector<Visit> visits;
  std::set<std::string> promised;  ///< what it shows, and causes whose class it tells apart
};

/// What the command said of a measurement.
struct Answer {
  int exit_code = -1;
  std::string text;  ///< of a failure
  std::vector<std::vector<std::string>> classes;
  std::vector<std::string> unexplained;
  std::set<std::string> not_observable;
  std::optional<Advice> advice;
  double seconds = 0.0;
};

enum class Outcome {
  correct,
  too_wide,            ///< a class holds what the judge puts beyond d = 6.6
  wrong_name,          ///< a truth in no class, and a cause whose class holds no truth
  missed,              ///< a truth in no class, nothing else found
  false_alarm,         ///< of nothing
  extra_finding,       ///< every truth in a class, and more
  not_called_unknown,  ///< named, or not seen
  not_abstained,       ///< something was found, or it is not listed as not observable
  no_advice,           ///< nothing is promised of this truth: no case of the advice
  unresolved,          ///< the advised measurement told no more
  crash
};
std::string to_string(Outcome outcome);

/// Members of classes listed with the truths.
struct Members {
  std::size_t listed = 0;
  std::size_t far = 0;        ///< with d ≥ 6.6 after the other true term
  std::size_t far_alone = 0;  ///< with d ≥ 6.6, were the other known
};

struct Result {
  Case made;
  Answer answer, advised;
  Outcome outcome = Outcome::crash;
  Members members;
  double calibrated_mm = 0.0, diagnosed_mm = 0.0;  ///< error of the tip elsewhere; 0: not asked
  double seconds = 0.0;
  std::string line() const;
};

struct StudyOptions {
  std::string command;
  std::filesystem::path scratch;
  bool keep = false;
  bool elsewhere = false;  ///< how far `calibrate` and `diagnose` are off at other positions
  int jobs = 2;
  std::function<void(std::size_t done, const Result&)> progress;
};

/// Kinds, layouts and plans in turn; a case depends on the seed and its number alone.
std::vector<Wanted> select(const std::vector<Kind>& kinds, std::size_t cases, std::uint64_t seed);
Wanted wanted_from(const std::string& id);

Result run_case(const Wanted& wanted, const StudyOptions& options);
std::vector<Result> run_study(const std::vector<Wanted>& wanted, const StudyOptions& options);

/// Writes FOLDER/machine.toml and data.csv and runs the command on them; the truth is written next
/// to the folder, where the command does not look.
Answer run_command(const Case& one, const Plan& plan, std::uint64_t noise_seed,
                   const std::string& command, const std::filesystem::path& folder);

/// The outcome of all kinds but advised, without the command.
Outcome score(const Case& one, const Answer& answer, Members& members);

/// Counts by kind, by layout, by plan, for the page.
nlohmann::json tables(const std::vector<Result>& results);

}  // namespace trueaxis::blind_machine
