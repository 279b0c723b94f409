// SPDX-License-Identifier: Apache-2.0
#include "cli/sweep_run.hpp"

#include <iostream>
#include <optional>

#include "cli/guarded.hpp"
#include "cli/terminal.hpp"
#include "format/outputs.hpp"
#include "report/sweep_report.hpp"
#include "studies/published/placement.hpp"
#include "studies/published/published_json.hpp"
#include "studies/published/published_page.hpp"
#include "studies/published/published_text.hpp"
#include "study/sweep/files/sweep_journal.hpp"
#include "study/sweep/files/sweep_results.hpp"
#include "study/sweep/summary.hpp"

namespace trueaxis::cli {

namespace {

void check_outputs(Outputs& outputs, const study::PublishedSweep& file, const std::string& folder,
                   const Results& results) {
  results.name_to(outputs, file.sweep.input_files);
  if (folder.empty()) return outputs.check();
  outputs.into(folder);
  outputs.may_write_in_folder("journal.bin", "");  // continued, or refused when it is opened
  outputs.may_write_in_folder("sweep.csv", "trueaxis.sweep");
  outputs.may_write_in_folder("sweep.json", "trueaxis.sweep");
  outputs.may_write_in_folder("timing.csv", "trueaxis.sweep_timing");
  outputs.may_write_in_folder("report.html", "trueaxis.sweep_report");
  if (file.published) outputs.may_write_in_folder("published.json", "trueaxis.published");
  outputs.check();
}

void write_results(Outputs& outputs, const study::PublishedSweep& file,
                   const study::Summary& summary,
                   const std::optional<study::Placement>& placement) {
  const study::Sweep& sweep = file.sweep;
  std::vector<SweepReportAddition> additions;
  if (placement) additions = published_page(sweep, *file.published, *placement);
  const auto write = [&](const char* name, const std::string& text) {
    outputs.write(outputs.in_folder(name), text);
  };
  write("sweep.csv", sweep_csv(sweep, summary));
  write("sweep.json", sweep_json(sweep, summary));
  write("timing.csv", sweep_timing_csv(sweep, summary));
  write("report.html", render_sweep_report(sweep, summary, additions));
  if (placement) write("published.json", published_json(sweep, *file.published, *placement));
}

}  // namespace

int check_sweep(const study::PublishedSweep& file, const std::string& folder,
                const Results& results) {
  Outputs outputs(results.force);
  check_outputs(outputs, file, folder, results);
  const std::size_t cells = study::cell_count(file.sweep);
  return checked(outputs, std::to_string(cells) + (cells == 1 ? " cell of " : " cells of ") +
                              std::to_string(file.sweep.repeats) + " simulated streams each, " +
                              std::to_string(cells * file.sweep.repeats) + " in all");
}

void run_sweep(const study::PublishedSweep& file, const std::string& folder, const Results& results,
               const BlockRunner& runner) {
  const study::Sweep& sweep = file.sweep;
  Outputs outputs(results.force);
  check_outputs(outputs, file, folder, results);
  if (!folder.empty()) outputs.make_folder();  // for the journal
  std::optional<SweepJournal> journal;
  if (!folder.empty()) journal.emplace(folder, sweep);
  std::vector<study::BlockResult> blocks;
  if (journal) blocks = journal->take_finished();
  const std::vector<study::Block> to_do = blocks_to_do(sweep, blocks);
  std::size_t repeats_to_do = 0;
  for (const study::Block& block : to_do) repeats_to_do += block.count;
  const std::size_t before = study::cell_count(sweep) * sweep.repeats - repeats_to_do;
  Progress progress(before, repeats_to_do, "repeats");
  runner(to_do, [&](study::BlockResult&& result) {
    if (journal) journal->append(result);
    progress.add(result.block.count);
    blocks.push_back(std::move(result));
  });
  progress.end();
  const study::Summary summary = study::summarise(sweep, blocks);
  std::optional<study::Placement> placement;
  if (file.published) placement = study::place_published(sweep, *file.published, blocks);
  if (!folder.empty()) write_results(outputs, file, summary, placement);
  results.write(outputs, "--json", [&] { return sweep_json(sweep, summary); });
  outputs.commit();
  if (results.printed()) return;
  std::cout << sweep_text(sweep, summary);
  if (placement) std::cout << '\n' << published_text(sweep, *file.published, summary, *placement);
  if (!folder.empty()) std::cout << folder << "/report.html\n";
  std::cout << results.line("result ", "--json");
}

}  // namespace trueaxis::cli
