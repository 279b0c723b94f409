// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "compensate/block_end.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

inline Vector3 mix(const Vector3& a, const Vector3& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}
inline AxisPositions mix(const AxisPositions& a, const AxisPositions& b, double s) {
  AxisPositions out;
  for (std::size_t k = 0; k < axis_count; ++k) out[k] = a[k] + s * (b[k] - a[k]);
  return out;
}

/// Whether a move turns rotary axes and moves no linear one, by its axes or by its words.
bool turns_alone(const AxisPositions& from, const AxisPositions& to);

/// A way is even if rotary axes turn less. The line of a longer one is 1.5 % of the radius off.
inline constexpr double even_turn_rad = 20.0 * rad_per_deg;

/// Whether a block whose axes go evenly means the way of the machine and no straight line: it turns
/// rotary axes alone, or one of them by more than 20°.
bool means_own_way(const AxisPositions& from, const AxisPositions& to);

/// What the tip should do in the part during a move (0 ≤ s ≤ 1): the straight line between its
/// nominal ends, or the way of the nominal machine, which for a chord of an arc is that on the arc.
class NominalWay {
 public:
  /// @param start_mm nominal tip where the move begins
  NominalWay(const CompensationTask& task, const nc::Move& move, const AxisPositions& from,
             const Vector3& start_mm, const BlockEnd& to);

  bool is_arc() const { return move_.arc != nc::Move::no_arc; }
  bool is_curve() const { return is_curve_; }
  const Vector3& start_mm() const { return start_mm_; }
  const Vector3& end_mm() const { return end_mm_; }
  /// Where the nominal machine puts the tip there.
  AxisPositions axes_at(double s) const;

  /// How far a tip is from the way. Near a curve, which other chords of an arc continue, the foot
  /// of the perpendicular is looked for from s on.
  double distance_mm(const Vector3& tip_mm, double s) const;
  /// How far two points are from each other across the straight line.
  double across_mm(const Vector3& a, const Vector3& b) const;

 private:
  /// Moves s to the foot of the perpendicular, or to an end of the curve.
  double from_curve_mm(const Vector3& tip_mm, double& s) const;
  double begins() const { return -static_cast<double>(move_.chord); }
  double ends() const { return is_arc() ? begins() + task_.program.arcs[move_.arc].chords() : 1.0; }
  Vector3 tip_at(double s) const;
  double apart_mm(const Vector3& a, const Vector3& b, double low, double high) const;

  const CompensationTask& task_;
  const nc::Move& move_;
  Setting setting_;
  AxisPositions from_, to_;
  Vector3 start_mm_{}, end_mm_{};
  bool is_curve_;
};

}  // namespace trueaxis
