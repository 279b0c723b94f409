// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "simulate/machine/control.hpp"

namespace trueaxis::virtual_machine {

/// What the tip should cut in a move of the nominal program. For a straight block it is the line
/// between the tips at its ends, for an arc the way of the nominal machine's tip. If axes go
/// evenly, but only rotary ones or one by more than 20°, it is that way too.
class NominalPath {
 public:
  NominalPath() = default;
  NominalPath(const Machine& machine, const ControlMove& move);
  double off_mm(const Vector3& tip_mm) const;

 private:
  double off_beside_mm(const Vector3& tip_mm, std::size_t nearest) const;

  const Machine* machine_ = nullptr;
  const ControlMove* move_ = nullptr;
  std::vector<Vector3> tips_mm_;  ///< even; of a straight line its ends
};

/// Where a move begins in what it goes evenly in: X Y Z of the axes, or the tip.
Vector3 lead_of(const Machine& machine, const ControlMove& move);

/// Of every move of a program the index of the move of the nominal program to which it belongs.
/// Pieces of a block come before the move that ends it: this has the other words of the block. The
/// first piece may have these too, and all lines of axis words have them. The block then ends where
/// the tool of the machine with its errors is nearer to its end than at the next such move. @throws
/// InputError (of `file`) where the program has not all moves of the nominal one
std::vector<std::size_t> nominal_moves_of(const Machine& machine, const ErrorModel& errors,
                                          std::span<const ControlMove> moves,
                                          std::span<const ControlMove> nominal,
                                          const std::string& file);

}  // namespace trueaxis::virtual_machine
