// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/study.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "blind_machine/elsewhere.hpp"
#include "machine/files/errors_files.hpp"
#include "support/case_runs.hpp"

namespace trueaxis::blind_machine {
namespace {

/// Members of the smallest class that holds the truth; 0: none does.
std::size_t class_size(const Answer& answer, const std::string& truth) {
  std::size_t least = 0;
  for (const auto& members : answer.classes)
    if (std::ranges::find(members, truth) != members.end() &&
        (least == 0 || members.size() < least))
      least = members.size();
  return least;
}

/// The plan with the advised visits after it; a new ball is within a millimetre of the wanted
/// place, and old ones are where they were.
Plan extended(const Case& one, const Advice& advice) {
  Plan plan = one.plan;
  double time_s = plan.visits.back().time_s;
  for (Visit visit : advice.visits) {
    const auto old = std::ranges::find(one.plan.visits, visit.ball, &Visit::ball);
    if (old != one.plan.visits.end())
      visit.centre_mm = old->centre_mm;
    else
      for (double& x : visit.centre_mm) x += 0.1;
    visit.time_s = time_s += pace_s;
    plan.visits.push_back(visit);
  }
  return plan;
}

Outcome follow_advice(Result& result, const StudyOptions& options,
                      const std::filesystem::path& folder) {
  if (result.answer.exit_code != 0) return Outcome::crash;
  if (result.made.truth.empty() || !result.answer.advice) return Outcome::no_advice;
  const std::string& truth = result.made.truth.front();
  const std::size_t before = class_size(result.answer, truth);
  const bool absorbed = before == 0;
  const std::set<std::string>& promised = result.answer.advice->promised;
  if (absorbed ? !promised.contains(truth) : before < 2 || promised.empty())
    return Outcome::no_advice;
  if (!absorbed && std::ranges::none_of(result.answer.classes, [&](const auto& members) {
        return std::ranges::find(members, truth) != members.end() &&
               promised.contains(members.front());
      }))
    return Outcome::no_advice;
  const Plan plan = extended(result.made, *result.answer.advice);
  if (plan.visits.size() == result.made.plan.visits.size()) return Outcome::crash;
  result.advised = run_command(result.made, plan, result.made.wanted.seed + 1, options.command,
                               folder / "advised");
  if (result.advised.exit_code != 0) return Outcome::crash;
  const std::size_t now = class_size(result.advised, truth);
  return now > 0 && (absorbed || now < before) ? Outcome::correct : Outcome::unresolved;
}

void look_elsewhere(Result& result, const StudyOptions& options,
                    const std::filesystem::path& folder) {
  const std::string at = '"' + folder.string();
  const auto off = [&](const std::string& arguments, const char* file) {
    const auto ran = testing::shell('"' + options.command + "\" " + arguments + " -o " + at + '/' +
                                    file + "\" --force");
    if (ran.exit_code != 0) throw std::runtime_error(ran.output);
    return error_elsewhere_mm(
        result.made, read_errors_toml((folder / file).string(), result.made.layout->machine));
  };
  result.calibrated_mm =
      off("machine calibrate --machine " + at + "/machine.toml\" " + at + "/data.csv\"",
          "calibrated.toml");
  result.diagnosed_mm =
      off("machine diagnose " + at + "/data.csv\" --machine " + at + "/machine.toml\"",
          "diagnosed.toml");
}

}  // namespace

std::vector<Wanted> select(const std::vector<Kind>& kinds, std::size_t cases, std::uint64_t seed) {
  std::vector<Wanted> list;
  const std::vector<std::string> plans = plan_names();
  for (std::size_t i = 0; i < cases; ++i) {
    const std::size_t round = i / kinds.size();
    list.push_back({kinds[i % kinds.size()], round % layouts().size(),
                    plans[(round + round / layouts().size()) % plans.size()],
                    testing::seed_of_case(seed, i)});
  }
  return list;
}

Wanted wanted_from(const std::string& id) {
  std::vector<std::string> words;
  std::string word;
  for (std::istringstream text(id); std::getline(text, word, '-');) words.push_back(word);
  if (words.size() != 4) throw std::invalid_argument("a case is KIND-LAYOUT-PLAN-SEED");
  for (const Kind kind : all_kinds())
    if (to_string(kind) == words[0])
      return {kind, std::stoul(words[1]), words[2], std::stoull(words[3])};
  throw std::invalid_argument("no kind is called " + words[0]);
}

Result run_case(const Wanted& wanted, const StudyOptions& options) {
  Result out;
  out.made = make_case(wanted);
  const std::filesystem::path folder = options.scratch / wanted.id();
  out.answer = run_command(out.made, out.made.plan, wanted.seed, options.command, folder);
  out.seconds = out.answer.seconds;
  if (options.elsewhere && out.answer.exit_code == 0) look_elsewhere(out, options, folder);
  out.outcome = wanted.kind == Kind::advised ? follow_advice(out, options, folder)
                                             : score(out.made, out.answer, out.members);
  if (!options.keep) testing::remove_case(folder);
  return out;
}

std::vector<Result> run_study(const std::vector<Wanted>& wanted, const StudyOptions& options) {
  return testing::run_cases<Result>(
      wanted, options.jobs, [&](const Wanted& one) { return run_case(one, options); },
      options.progress);
}

}  // namespace trueaxis::blind_machine
