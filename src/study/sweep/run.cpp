// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/run.hpp"

#include <memory>
#include <mutex>
#include <utility>

#include "base/threads.hpp"

namespace trueaxis::study {

void run_blocks(const Sweep& sweep, std::span<const Block> blocks, int threads,
                const std::function<void(BlockResult&&)>& finished) {
  std::mutex one_at_a_time;
  for_each_index_with(blocks.size(), threads, [&]() -> IndexedWork {
    return [&, worker = std::make_shared<Worker>(sweep)](std::size_t i) {
      BlockResult result = worker->run(blocks[i]);
      const std::lock_guard lock(one_at_a_time);
      finished(std::move(result));
    };
  });
}

}  // namespace trueaxis::study
