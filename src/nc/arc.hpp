// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nc/axes.hpp"
#include "nc/modal.hpp"

namespace trueaxis::nc {

/// An arc of a block in a plane of two linear axes; every other axis moves in proportion to the
/// angle. G2 turns from the plane's first axis (X of G17, Z of G18, Y of G19) away from its second.
struct Arc {
  AxisValues from{}, to{};  ///< mm, rad
  Plane plane = Plane::xy;
  bool clockwise = true;
  /// From `from` to the centre (I J K).
  std::array<std::optional<double>, 3> centre_mm{};
  /// Instead of the centre; negative: the way of more than half a turn.
  std::optional<double> radius_mm{};
};

/// Points within an arc, so that its chords stay within `tolerance_mm` of it; the ends are not
/// among them. If it is not an arc, `trouble` says why and what to do.
std::vector<AxisValues> chords_of(const Arc& arc, double tolerance_mm, std::string& trouble);

}  // namespace trueaxis::nc
