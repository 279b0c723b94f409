// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <optional>

#include "simulate/machine/block_words.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis::virtual_machine {

/// An arc in a plane of two of X Y Z, as complex numbers first + i second. It is of positions of
/// the axes, or of the tip. What lies across the plane, and every rotary axis, goes evenly with the
/// angle.
struct ArcWay {
  std::size_t first = 0, second = 1;  ///< G17: X Y, G18: Z X, G19: Y Z
  std::complex<double> centre_mm;
  double turn_rad = 0.0;  ///< from the first towards the second axis

  std::complex<double> in_plane(const Vector3& point) const {
    return {point[first], point[second]};
  }
  /// `even`, which went evenly, put on the arc from `from` to `to`; their distances from the centre
  /// pass into each other.
  Vector3 put_on_arc(Vector3 even, const Vector3& from, const Vector3& to, double share) const;
  double length_mm(const Vector3& from) const;
};

/// The arc of G2 (`clockwise`) or G3 by I J K from its start, or R (negative: more than half a
/// turn). Nothing where the words make none.
std::optional<ArcWay> arc_of(const BlockWords& block, double unit_mm, int plane, bool clockwise,
                             const Vector3& from, const Vector3& to);

}  // namespace trueaxis::virtual_machine
