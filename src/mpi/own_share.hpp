// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "study/sweep/block.hpp"

namespace trueaxis::mpi {

/// The blocks that rank 0 runs itself, on a thread of its own.
class OwnShare {
 public:
  using Run = std::function<study::BlockResult(const study::Block&)>;

  /// @param make  makes what runs a block, on the thread: it may throw as a block may
  OwnShare(std::function<Run()> make, const std::vector<study::Block>& blocks,
           std::atomic<std::size_t>& next)
      : make_(std::move(make)), blocks_(blocks), next_(next), thread_([this] { work(); }) {}
  ~OwnShare() {
    next_ = blocks_.size();
    thread_.join();
  }
  OwnShare(const OwnShare&) = delete;
  OwnShare& operator=(const OwnShare&) = delete;

  /// What is done since the last call. @throws what a block threw.
  std::vector<study::BlockResult> take() {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    return std::exchange(done_, {});
  }

 private:
  void work() {
    try {
      const Run run = make_();
      for (std::size_t i = next_++; i < blocks_.size(); i = next_++) {
        study::BlockResult result = run(blocks_[i]);
        const std::lock_guard lock(mutex_);
        done_.push_back(std::move(result));
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }

  std::function<Run()> make_;
  const std::vector<study::Block>& blocks_;
  std::atomic<std::size_t>& next_;
  std::mutex mutex_;
  std::vector<study::BlockResult> done_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace trueaxis::mpi
