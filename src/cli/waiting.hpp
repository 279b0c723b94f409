// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trueaxis::cli {

/// What a command is at while it computes, for work without a count (Progress is of work with one):
/// where standard error is a terminal, a line there from two seconds on, "diagnosing shaft.csv, 7
/// s", gone at the end. Nothing elsewhere.
class Waiting {
 public:
  explicit Waiting(std::string doing);
  ~Waiting();
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  void show();
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string doing_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace trueaxis::cli
