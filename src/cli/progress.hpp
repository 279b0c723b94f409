// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace trueaxis::cli {

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
