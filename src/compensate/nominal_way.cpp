// SPDX-License-Identifier: Apache-2.0
#include "compensate/nominal_way.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis {

namespace {

/// The largest way of axes from `first` to before `last`.
double most_of(const AxisPositions& from, const AxisPositions& to, std::size_t first,
               std::size_t last) {
  double most = 0.0;
  for (std::size_t k = first; k < last; ++k) most = std::max(most, std::abs(to[k] - from[k]));
  return most;
}

}  // namespace

bool turns_alone(const AxisPositions& from, const AxisPositions& to) {
  constexpr double still_mm = 1e-9;
  return most_of(from, to, 3, axis_count) > 0.0 && most_of(from, to, 0, 3) < still_mm;
}

bool means_own_way(const AxisPositions& from, const AxisPositions& to) {
  constexpr double rounding_rad = 1e-9;  // of positions: exactly 20° is not more
  return most_of(from, to, 3, axis_count) > even_turn_rad + rounding_rad || turns_alone(from, to);
}

NominalWay::NominalWay(const CompensationTask& task, const nc::Move& move,
                       const AxisPositions& from, const Vector3& start_mm, const BlockEnd& to)
    : task_(task),
      move_(move),
      setting_(task.axes.setting(move.modal)),
      from_(from),
      to_(to.commanded),
      start_mm_(start_mm),
      end_mm_(to.tip_mm),
      is_curve_(is_arc() ||
                (task.axes.mode(move.modal) == ProgramMode::axes && means_own_way(from_, to_))) {}

AxisPositions NominalWay::axes_at(double s) const {
  const AxisPositions even = mix(from_, to_, s);
  if (!is_curve_)
    return axes_for_tip(task_.model, mix(start_mm_, end_mm_, s), even, setting_).value_or(even);
  if (!is_arc()) return even;
  const nc::AxisValues words = task_.program.arcs[move_.arc].after(move_.chord + s);
  return task_.axes.positions(words, move_.modal).value_or(even);
}

Vector3 NominalWay::tip_at(double s) const {
  return task_.model.nominal(axes_at(s), setting_).tip_mm;
}

double NominalWay::distance_mm(const Vector3& tip_mm, double s) const {
  if (!is_curve_) return apart_mm(tip_mm, start_mm_, 0.0, 1.0);
  const double off_mm = from_curve_mm(tip_mm, s);
  if (s != begins() && s != ends()) return off_mm;
  // A whole turn ends where it begins.
  double other = s == begins() ? ends() : begins();
  return std::min(off_mm, from_curve_mm(tip_mm, other));
}

double NominalWay::across_mm(const Vector3& a, const Vector3& b) const {
  return apart_mm(a, b, -INFINITY, INFINITY);
}

/// Gauss-Newton along the curve. Its last step goes along the tangent, whose distance from the arc
/// is of second order in it.
double NominalWay::from_curve_mm(const Vector3& tip_mm, double& s) const {
  constexpr double ahead = 1e-4, settled_mm = 1e-5;
  constexpr int most_steps = 20;
  const double first = begins(), last = ends();
  double off_mm = 0.0;
  for (int step = 0; step < most_steps; ++step) {
    const Vector3 here = tip_at(s), there = tip_at(s + ahead);
    double square = 0.0, rate = 0.0, along = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = tip_mm[i] - here[i], tangent = (there[i] - here[i]) / ahead;
      square += off * off;
      rate += tangent * tangent;
      along += off * tangent;
    }
    off_mm = std::sqrt(square);
    const double next = rate > 0.0 ? std::clamp(s + along / rate, first, last) : s;
    const double moved_mm = std::abs(next - s) * std::sqrt(rate);
    const bool stays = next == s, at_an_end = next == first || next == last;
    if (stays) break;
    if (moved_mm < settled_mm && !at_an_end)
      return std::sqrt(std::max(0.0, square - along * along / rate));
    s = next;
  }
  return off_mm;
}

double NominalWay::apart_mm(const Vector3& a, const Vector3& b, double low, double high) const {
  Vector3 along, off;
  double length = 0.0, projected = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    along[i] = end_mm_[i] - start_mm_[i];
    off[i] = a[i] - b[i];
    length += along[i] * along[i];
    projected += along[i] * off[i];
  }
  const double s = length > 0.0 ? std::clamp(projected / length, low, high) : 0.0;
  return std::hypot(off[0] - s * along[0], off[1] - s * along[1], off[2] - s * along[2]);
}

}  // namespace trueaxis
