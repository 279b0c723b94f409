// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace trueaxis::cli {

/// `--verbose` of a command that prints a screen.
CLI::Option* add_verbose(CLI::App& command, bool& verbose);

/// Prints a screen to standard output: its lines broken to the width of the terminal (100 where
/// there is none, and the first is left whole there), below their text, and its first word, the
/// verdict, in colour on a terminal where NO_COLOR is not set.
void print_screen(const std::string& text);

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

/// A line on standard error with share, rate and time left; nothing where that is no terminal.
class Progress {
 public:
  /// `before`: done by an earlier run.
  Progress(std::size_t before, std::size_t to_do, std::string unit);
  void add(std::size_t count);
  void end();

 private:
  void show();
  using Clock = std::chrono::steady_clock;
  std::size_t before_, to_do_, done_ = 0;
  std::string unit_;
  bool on_terminal_;
  Clock::time_point begun_, shown_;
};

}  // namespace trueaxis::cli
