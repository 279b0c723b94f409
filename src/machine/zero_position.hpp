// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Rz(θ) Tz(d) Tx(a) Rx(α): one row of a Denavit-Hartenberg table, with the errors of its numbers.
struct DenavitHartenbergRow {
  struct Numbers {
    double theta_rad = 0.0, d_mm = 0.0, a_mm = 0.0, alpha_rad = 0.0;
  };
  Numbers nominal, errors;
  std::optional<AxisName> axis;  ///< whose position is added to θ (rotary) or d (linear)
};

/// A chain of rows from the part to the tool, which lies along z of the last frame.
struct DenavitHartenbergChain {
  Vector3 part_translation_mm{};
  std::vector<DenavitHartenbergRow> rows;
  double tool_length_mm = 0.0;
};

/// The lines of the axes, the gauge point (origin of the last frame) and the tool's direction in
/// the frame of the part, all variables at 0. The tip is at + length along z of the last frame,
/// so that the direction from tip to holder is −z.
void to_zero_position(const DenavitHartenbergChain& chain, Machine& machine);

/// The errors of the numbers as location errors of the lines of `machine` (already in zero
/// position) and of the spindle, exact: X0K … C0K without what turns or moves a line in itself, and
/// X0S … C0S. @throws InputError where a line cannot be turned into the actual one that way.
ErrorModel parameter_errors(const DenavitHartenbergChain& chain, const Machine& machine);

}  // namespace trueaxis
