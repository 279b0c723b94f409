// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "compensate/block_end.hpp"
#include "machine/held_axes.hpp"

namespace trueaxis {

/// Which rotary axes a move must not turn. A block that moves a rotary axis makes its change, which
/// stays until the next one that does. An axis that the program does not move therefore does not
/// move. Before the first block the axes are where [program] start has them, and else at the word
/// 0: what the program never moves from there is not changed at all.
class RotaryHold {
 public:
  explicit RotaryHold(const CompensationTask& task);

  /// Axes that move `i` of the program does not turn, with the change that they keep.
  HeldAxes of(std::size_t i) const;

 private:
  using Since = std::array<std::uint32_t, 3>;  ///< of A B C: the move that turned it last
  void find_turns(const CompensationTask& task);
  void make_changes(const CompensationTask& task);

  std::vector<Since> since_;
  std::unordered_map<std::uint32_t, AxisPositions> changes_;  ///< of moves that later ones keep
};

}  // namespace trueaxis
