// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "support/command.hpp"

/// What the blind studies of the lathe and of machines share: many cases of a seed, each judged by
/// the command, its truth sealed next to it.
namespace trueaxis::testing {

/// Seed of case i of a study: splitmix64 (Steele, Lea, Flood 2014), neighbouring numbers, unrelated
/// seeds.
inline std::uint64_t seed_of_case(std::uint64_t study_seed, std::size_t i) {
  std::uint64_t x = study_seed * 0x100000001B3ULL + i;
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return (x ^ (x >> 31U)) % 1000000007ULL;
}

/// run(wanted[i]) of every case, `jobs` at a time, in the order of the cases; `progress`, if there
/// is one, gets how many are done and the last, one at a time. Rethrows what a case throws, after
/// those that were begun.
template <class Result, class Wanted, class Run, class Progress>
std::vector<Result> run_cases(const std::vector<Wanted>& wanted, int jobs, Run run,
                              const Progress& progress) {
  std::vector<Result> results(wanted.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t done = 0;
  std::exception_ptr failed;
  const auto work = [&] {
    for (std::size_t i = next++; i < wanted.size(); i = next++) {
      try {
        results[i] = run(wanted[i]);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress(done, results[i]);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failed = std::current_exception();
        next = wanted.size();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < std::max(1, jobs); ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (failed) std::rethrow_exception(failed);
  return results;
}

/// The place of the truth of a case: next to the folder that the command sees.
inline std::filesystem::path truth_path(const std::filesystem::path& folder) {
  return folder.string() + ".truth.json";
}

inline void remove_case(const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  std::filesystem::remove(truth_path(folder));
}

/// What `read` makes of the JSON that a command writes, with how long it took; if a command fails,
/// or its output cannot be read, the exit code and the text.
template <class Answer, class Read>
Answer timed_answer(const std::string& command, const std::filesystem::path& json, Read read) {
  const auto start = std::chrono::steady_clock::now();
  const CommandResult ran = shell(command);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  Answer answer;
  const bool answered = ran.exit_code <= 1;  // 1: the axis is not known, and all else is written
  try {
    if (answered) answer = read(read_json(json));
  } catch (const std::exception& wrong) {
    answer = Answer{};
    answer.text = wrong.what();
  }
  if (!answered) {
    answer.exit_code = ran.exit_code;
    answer.text = ran.output.substr(0, 400);
  }
  answer.seconds = took.count();
  return answer;
}

}  // namespace trueaxis::testing
