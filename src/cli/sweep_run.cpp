// SPDX-License-Identifier: Apache-2.0
#include "cli/sweep_run.hpp"

#include <iostream>
#include <optional>

#include "cli/progress.hpp"
#include "format/file.hpp"
#include "report/sweep_report.hpp"
#include "studies/published/placement.hpp"
#include "studies/published/published_json.hpp"
#include "studies/published/published_page.hpp"
#include "studies/published/published_text.hpp"
#include "study/sweep/files/sweep_csv.hpp"
#include "study/sweep/files/sweep_journal.hpp"
#include "study/sweep/files/sweep_json.hpp"
#include "study/sweep/files/sweep_text.hpp"
#include "study/sweep/summary.hpp"

namespace trueaxis::cli {

namespace {

void write_results(const study::PublishedSweep& file, const std::string& folder,
                   const study::Summary& summary,
                   const std::optional<study::Placement>& placement) {
  const study::Sweep& sweep = file.sweep;
  const std::string csv = sweep_csv(sweep, summary), json = sweep_json(sweep, summary);
  const std::string timing = sweep_timing_csv(sweep, summary);
  std::vector<SweepReportAddition> additions;
  std::string published;
  if (placement) {
    additions = published_page(sweep, *file.published, *placement);
    published = published_json(sweep, *file.published, *placement);
  }
  const std::string report = render_sweep_report(sweep, summary, additions);
  std::vector<FileContent> files{{folder + "/sweep.csv", csv},
                                 {folder + "/sweep.json", json},
                                 {folder + "/timing.csv", timing},
                                 {folder + "/report.html", report}};
  if (placement) files.push_back({folder + "/published.json", published});
  write_files(files);
}

}  // namespace

void run_sweep(const study::PublishedSweep& file, const std::string& folder,
               const BlockRunner& runner) {
  const study::Sweep& sweep = file.sweep;
  std::optional<SweepJournal> journal;
  if (!folder.empty()) journal.emplace(folder, sweep);
  std::vector<study::BlockResult> results;
  if (journal) results = journal->take_finished();
  const std::vector<study::Block> to_do = blocks_to_do(sweep, results);
  std::size_t repeats_to_do = 0;
  for (const study::Block& block : to_do) repeats_to_do += block.count;
  const std::size_t before = study::cell_count(sweep) * sweep.repeats - repeats_to_do;
  Progress progress(before, repeats_to_do, "repeats");
  runner(to_do, [&](study::BlockResult&& result) {
    if (journal) journal->append(result);
    progress.add(result.block.count);
    results.push_back(std::move(result));
  });
  progress.end();
  const study::Summary summary = study::summarise(sweep, results);
  std::optional<study::Placement> placement;
  if (file.published) placement = study::place_published(sweep, *file.published, results);
  if (!folder.empty()) write_results(file, folder, summary, placement);
  std::cout << sweep_text(sweep, summary);
  if (placement) std::cout << '\n' << published_text(sweep, *file.published, summary, *placement);
  if (!folder.empty()) std::cout << folder << "/report.html\n";
}

}  // namespace trueaxis::cli
