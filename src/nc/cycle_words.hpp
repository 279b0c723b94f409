// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nc/block.hpp"
#include "nc/cycle.hpp"
#include "nc/program.hpp"

namespace trueaxis::nc {

/// The words of canned cycles, which stay in force from block to block until the cycle ends: R and
/// Z as levels, Q, P.
class CycleWords {
 public:
  /// A cycle begins where none was in force, with the tool at this Z.
  void begin(double z_mm);

  /// Takes the words of a block in; whether it makes the cycle's moves.
  bool take(const Block& block, const ModalState& state, const std::vector<Word>& of_program);

  /// Why the block is not a cycle; empty: it is.
  /// @param from words in force before the block
  std::string trouble(const Block& block, const ModalState& state, const AxisValues& from,
                      AxisSet axes) const;
  Cycle cycle(const Block& block, const ModalState& state, const AxisValues& from) const;

  std::uint8_t decimals() const { return decimals_; }  ///< of R
  std::uint32_t dwell() const { return dwell_; }       ///< index of P, Move::no_dwell: none

 private:
  double initial_mm_ = 0.0, peck_mm_ = 0.0;
  std::optional<double> r_mm_, bottom_mm_;
  std::uint8_t decimals_ = 0;
  std::uint32_t dwell_ = Move::no_dwell;
};

}  // namespace trueaxis::nc
