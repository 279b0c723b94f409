// SPDX-License-Identifier: Apache-2.0
#include "blind/study.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "blind/advice.hpp"

namespace trueaxis::blind {
namespace {

// splitmix64 (Steele, Lea, Flood 2014): neighbouring numbers, unrelated seeds.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

}  // namespace

std::vector<Wanted> select(const Selection& selection) {
  std::vector<Wanted> list;
  const std::size_t kinds = selection.kinds.size(), plans = selection.plans.size();
  const std::size_t surfaces = selection.surfaces.size();
  for (std::size_t i = 0; i < selection.cases; ++i) {
    Wanted wanted;
    wanted.kind = selection.kinds[i % kinds];
    wanted.plan = selection.plans[i / kinds % plans];
    wanted.surface = selection.surfaces[i / (kinds * plans) % surfaces];
    wanted.seed = mixed(selection.seed * 0x100000001B3ULL + i) % 1000000007ULL;
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
  if (!options.keep) {
    std::filesystem::remove_all(folder);
    std::filesystem::remove(folder.string() + ".truth.json");
  }
  return result;
}

std::vector<Result> run_study(const std::vector<Wanted>& wanted, const StudyOptions& options) {
  std::vector<Result> results(wanted.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t done = 0;
  std::exception_ptr failed;
  const auto work = [&] {
    for (std::size_t i = next++; i < wanted.size(); i = next++) {
      try {
        results[i] = run_case(wanted[i], options);
        const std::lock_guard lock(mutex);
        ++done;
        if (options.progress) options.progress(done, results[i]);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failed = std::current_exception();
        next = wanted.size();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < std::max(1, options.jobs); ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (failed) std::rethrow_exception(failed);
  return results;
}

}  // namespace trueaxis::blind
