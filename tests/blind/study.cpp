// SPDX-License-Identifier: Apache-2.0
#include "blind/study.hpp"

#include <algorithm>

#include "blind/advice.hpp"
#include "support/case_runs.hpp"

namespace trueaxis::blind {

std::vector<Wanted> select(const Selection& selection) {
  std::vector<Wanted> list;
  const std::size_t kinds = selection.kinds.size(), plans = selection.plans.size();
  const std::size_t surfaces = selection.surfaces.size();
  for (std::size_t i = 0; i < selection.cases; ++i) {
    Wanted wanted;
    wanted.kind = selection.kinds[i % kinds];
    wanted.plan = selection.plans[i / kinds % plans];
    wanted.surface = selection.surfaces[i / (kinds * plans) % surfaces];
    wanted.seed = testing::seed_of_case(selection.seed, i);
    list.push_back(wanted);
  }
  return list;
}

Result run_case(const Wanted& wanted, const StudyOptions& options) {
  Result result;
  result.made = make_case(wanted);
  const std::filesystem::path folder = options.scratch / result.made.id;
  write_sealed(result.made, folder);
  result.answer = run_command(options.command, folder, wanted.surface);
  result.score = score(result.made, open_truth(folder), result.answer);
  if (options.follow_advice) follow_advice(result, options.command, folder);
  if (!options.keep) testing::remove_case(folder);
  return result;
}

std::vector<Result> run_study(const std::vector<Wanted>& wanted, const StudyOptions& options) {
  return testing::run_cases<Result>(
      wanted, options.jobs, [&](const Wanted& one) { return run_case(one, options); },
      options.progress);
}

}  // namespace trueaxis::blind
