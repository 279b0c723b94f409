// SPDX-License-Identifier: Apache-2.0
#include "base/threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/stop.hpp"

namespace trueaxis {

std::size_t threads_for(int asked, std::size_t count) {
  const std::size_t some = asked > 0 ? static_cast<std::size_t>(asked)
                                     : std::max(1U, std::thread::hardware_concurrency());
  return std::clamp<std::size_t>(count, 1, some);
}

void for_each_index_with(std::size_t count, int threads, const std::function<IndexedWork()>& make) {
  std::atomic<std::size_t> next = 0;
  std::mutex one_at_a_time;
  std::exception_ptr failure;
  std::size_t failed = count;
  const auto loop = [&] {
    std::size_t i = 0;
    try {
      const IndexedWork work = make();
      for (i = next++; i < count; i = next++) {
        stop_if_asked();
        work(i);
      }
    } catch (...) {
      // Every index below i is done or still at work, so the least that fails is always found.
      next = count;
      const std::lock_guard lock(one_at_a_time);
      if (!failure || i < failed) failure = std::current_exception(), failed = i;
    }
  };
  const auto helper = [&, asked = stopped_by(), share = share_done()] {
    const Stoppable stoppable(asked, share);
    loop();
  };
  std::vector<std::thread> helpers;
  try {
    for (std::size_t t = threads_for(threads, count); t > 1; --t) helpers.emplace_back(helper);
  } catch (const std::system_error&) {
    // The system gives no more threads: those that run do the work.
  }
  loop();
  for (std::thread& each : helpers) each.join();
  if (failure) std::rethrow_exception(failure);
}

void for_each_index(std::size_t count, int threads, const IndexedWork& work) {
  for_each_index_with(count, threads, [&] { return work; });
}

}  // namespace trueaxis
