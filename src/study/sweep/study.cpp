// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/study.hpp"

#include <utility>

#include "study/sweep/block.hpp"
#include "study/sweep/summary.hpp"

namespace trueaxis::study {

std::vector<Spread> repeat(const virtual_lathe::Scenario& scenario, const RepeatOptions& options) {
  Sweep sweep;  // a grid of one cell
  sweep.base = scenario;
  if (options.surface) sweep.surface = to_string(*options.surface);
  sweep.methods = {options.loss == Loss::plain   ? Method::fit
                   : options.loss == Loss::huber ? Method::huber
                                                 : Method::tukey};
  sweep.repeats = options.repeats;
  sweep.seed = options.seed;
  std::vector<BlockResult> results;
  run_blocks(sweep, blocks_of(sweep), options.threads,
             [&](BlockResult&& result) { results.push_back(std::move(result)); });
  std::vector<Spread> spreads;
  for (const Row& row : summarise(sweep, results).rows) {
    spreads.push_back({row.quantity, row.unit, row.truth, row.bias, row.u_bias, row.sd, row.bound,
                       row.coverage.value, row.estimates});
  }
  return spreads;
}

}  // namespace trueaxis::study
