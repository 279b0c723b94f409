// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/sweep_run.hpp"
#include "studies/published/published_toml.hpp"
#include "study/sweep/block.hpp"

namespace trueaxis::cli {

void add_sweep(CLI::App* command, int& exit_code) {
  struct Options {
    std::string sweep, folder;
    Results results;
    int threads = 0;
    bool check = false;
  };
  auto options = std::make_shared<Options>();
  command->add_option("sweep", options->sweep, "sweep (TOML)")->required();
  add_place(*command, "-o,--output", options->folder,
            "folder for results, report and journal (default none: nothing is kept)");
  add_json(*command, options->results, "trueaxis.sweep");
  add_usual(*command, options->results.force, options->check);
  add_threads(*command, options->threads);
  command->callback([options, &exit_code] {
    const study::PublishedSweep file = read_published_sweep(options->sweep);
    if (options->check) {
      exit_code = check_sweep(file, options->folder, options->results);
      return;
    }
    run_sweep(file, options->folder, options->results,
              [&](const auto& blocks, const auto& finished) {
                study::run_blocks(file.sweep, blocks, options->threads, finished);
              });
    exit_code = done;
  });
}

}  // namespace trueaxis::cli
