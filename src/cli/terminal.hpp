// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace trueaxis::cli {

/// `--verbose` of a command that prints a screen.
CLI::Option* add_verbose(CLI::App& command, bool& verbose);

/// Prints a screen to standard output, with its lines broken to the width of the terminal. Without
/// a terminal the width is 100 and the first line stays whole. The verdict, its first word, has a
/// colour on a terminal unless NO_COLOR is set.
void print_screen(const std::string& text);

/// What a command does while it computes, for work without a count (Progress is for work with one).
/// If standard error is a terminal, it shows a line from two seconds on, "diagnosing shaft.csv, 7
/// s", gone at the end.
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

/// A line on standard error with share, rate and time left, if that is a terminal. The share also
/// goes to share_done().
class Progress {
 public:
  /// `before`: done by an earlier run.
  Progress(std::size_t before, std::size_t to_do, std::string unit);
  void add(std::size_t count);
  void end();

 private:
  void show();
  double share() const;
  using Clock = std::chrono::steady_clock;
  std::size_t before_, to_do_, done_ = 0;
  std::string unit_;
  bool on_terminal_;
  Clock::time_point begun_, shown_;
  std::atomic<double>* share_;
};

}  // namespace trueaxis::cli
