// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/study/run.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace trueaxis::study {

void run_blocks(const Sweep& sweep, std::span<const Block> blocks, int threads,
                const std::function<void(BlockResult&&)>& finished) {
  std::atomic<std::size_t> next = 0;
  std::mutex one_at_a_time;
  std::exception_ptr failure;
  const auto work = [&] {
    Worker worker(sweep);
    try {
      for (std::size_t i = next++; i < blocks.size(); i = next++) {
        BlockResult result = worker.run(blocks[i]);
        const std::lock_guard lock(one_at_a_time);
        finished(std::move(result));
      }
    } catch (...) {
      next = blocks.size();
      const std::lock_guard lock(one_at_a_time);
      if (!failure) failure = std::current_exception();
    }
  };
  const auto most = static_cast<int>(std::max<std::size_t>(blocks.size(), 1));
  const int asked = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> helpers;
  for (int i = 1; i < std::min(std::max(asked, 1), most); ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace trueaxis::study
