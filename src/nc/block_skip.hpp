// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "nc/program.hpp"

namespace trueaxis::nc {

/// Where the axes are if the control skips the blocks that begin with `/`, or `/` and a digit: of
/// each of its switches alone. Asked about a line before it is passed, line by line.
class BlockSkip {
 public:
  explicit BlockSkip(const Program& program);

  /// Why this line (from 0) gets no new word of the axis, which is elsewhere if a line before was
  /// skipped; once for each of these. Empty: the axis is where its word in force says.
  std::string trouble(std::size_t line, std::size_t axis);
  void pass(std::size_t line);

 private:
  std::size_t skipped_before(std::size_t line, std::size_t axis) const;

  struct Skipped {
    AxisValues words{};                          ///< in force if the switch is on
    std::array<std::uint32_t, axis_count> by{};  ///< the last line of the switch with the axis
  };

  const Program& program_;
  std::array<Skipped, 10> switches_;  ///< by digit; `/` alone is that of 1
  AxisValues words_{};                ///< in force if nothing is skipped
  std::size_t next_ = 0;              ///< of the moves
  std::size_t work_offset_ = 0;
  AxisSet restated_ = 0;  ///< by lines that are not yet a position
  bool any_ = false;
  std::array<std::size_t, axis_count> told_{};  ///< number of the skipped line
};

}  // namespace trueaxis::nc
