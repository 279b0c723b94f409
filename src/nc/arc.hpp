// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

/// The way of an arc, and in how many chords it goes.
class ArcWay {
 public:
  /// By as many chords as stay within `tolerance_mm` of it. If it is not an arc, `trouble` says why
  /// and what to do.
  static std::optional<ArcWay> of(const Arc& arc, double tolerance_mm, std::string& trouble);

  std::uint32_t chords() const { return chords_; }
  /// Words after `chords` of them, which may end within a chord.
  AxisValues after(double chords) const;

 private:
  AxisValues from_{}, to_{};
  std::size_t u_ = 0, v_ = 1;
  double centre_u_ = 0.0, centre_v_ = 0.0, from_radius_ = 0.0, to_radius_ = 0.0;
  double start_rad_ = 0.0, turn_rad_ = 0.0;
  std::uint32_t chords_ = 1;
};

}  // namespace trueaxis::nc
