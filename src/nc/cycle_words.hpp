// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nc/block.hpp"
#include "nc/modal.hpp"
#include "nc/program.hpp"

namespace trueaxis::nc {

/// A canned drilling cycle along Z as its block commands it (G81, G82, G83). All in mm, words of
/// the program.
struct Cycle {
  int code = 81;
  double from_mm[3] = {};  ///< where the tool is: X Y Z
  double to_mm[2] = {};    ///< X Y of the first hole
  double step_mm[2] = {};  ///< from one hole to the next, under G91
  int holes = 1;           ///< K or L
  double r_mm = 0.0, bottom_mm = 0.0;
  double initial_mm = 0.0;  ///< Z where the series of cycles began
  bool to_r = false;        ///< G99: back to R; G98: to the initial level
  double peck_mm = 0.0;     ///< Q of G83
};

/// A straight move of a cycle.
struct CycleStep {
  double at_mm[3] = {};  ///< X Y Z
  bool feed = false;     ///< G1, else G0
  bool bottom = false;   ///< where G82 dwells
};

/// The moves of a cycle, as LinuxCNC makes them: up to R where the tool is below it, above the
/// hole, to R, down, back. G83 goes back to R after every Q and down again to 0.254 mm above where
/// it was. The first of them goes above the first hole or up to R. G98 after G99 goes over the next
/// hole at the initial level (FANUC goes at R, lower).
/// @param trouble why it is not a cycle, and what to do
std::vector<CycleStep> steps_of(const Cycle& cycle, std::string& trouble);

/// The words of canned cycles, which stay in force from block to block until the cycle ends: R,
/// Z, Q, P.
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
  /// ", R-98 Z-14.5 for the levels of before": as the block would have to give them.
  std::string levels_as_words(const Block& block, const ModalState& state) const;

  double initial_mm_ = 0.0, peck_mm_ = 0.0;
  std::optional<double> r_mm_, z_mm_;  ///< as written
  bool incremental_ = false;           ///< R and Z were written under G91
  std::uint8_t decimals_ = 0;
  std::uint32_t dwell_ = Move::no_dwell;
};

}  // namespace trueaxis::nc
