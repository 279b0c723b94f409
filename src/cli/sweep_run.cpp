// SPDX-License-Identifier: Apache-2.0
#include "cli/sweep_run.hpp"

#include <iostream>

#include "cli/progress.hpp"
#include "trueaxis/io/file.hpp"
#include "trueaxis/io/sweep_journal.hpp"
#include "trueaxis/io/sweep_results.hpp"
#include "trueaxis/study/summary.hpp"

namespace trueaxis::cli {

void run_sweep(const study::Sweep& sweep, const std::string& folder, const BlockRunner& runner) {
  SweepJournal journal(folder, sweep);
  std::vector<study::BlockResult> results = journal.take_finished();
  const std::vector<study::Block> to_do = blocks_to_do(sweep, results);
  std::size_t repeats_to_do = 0;
  for (const study::Block& block : to_do) repeats_to_do += block.count;
  const std::size_t before = study::cell_count(sweep) * sweep.repeats - repeats_to_do;
  Progress progress(before, repeats_to_do, "repeats");
  runner(to_do, [&](study::BlockResult&& result) {
    journal.append(result);
    progress.add(result.block.count);
    results.push_back(std::move(result));
  });
  progress.end();
  const study::Summary summary = study::summarise(sweep, results);
  const std::string csv = sweep_csv(sweep, summary), json = sweep_json(sweep, summary);
  const std::string timing = sweep_timing_csv(sweep, summary);
  const FileContent files[] = {{folder + "/sweep.csv", csv},
                               {folder + "/sweep.json", json},
                               {folder + "/timing.csv", timing}};
  write_files(files);
  std::cout << sweep_text(sweep, summary) << folder << "/sweep.csv\n";
}

}  // namespace trueaxis::cli
