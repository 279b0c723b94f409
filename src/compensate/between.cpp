// SPDX-License-Identifier: Apache-2.0
#include "compensate/between.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace trueaxis {
namespace {

constexpr std::size_t most_pieces = 10000;

Vector3 mix(const Vector3& a, const Vector3& b, double s) {
  return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}
AxisPositions mix(const AxisPositions& a, const AxisPositions& b, double s) {
  AxisPositions out;
  for (std::size_t k = 0; k < axis_count; ++k) out[k] = a[k] + s * (b[k] - a[k]);
  return out;
}

}  // namespace

BlockPath::BlockPath(const CompensationTask& task, const nc::Move& move, const BlockEnd& from,
                     const BlockEnd& to)
    : task_(task),
      move_(move),
      from_(from),
      to_(to),
      setting_(task.axes.setting(move.modal)),
      start_mm_(task.model.nominal(from.commanded, setting_).tip_mm),
      end_mm_(to.tip_mm) {}

Vector3 BlockPath::tip_at(double s) const { return mix(start_mm_, end_mm_, s); }

/// Where a control is on the way: its axes go evenly, or the tip and the rotary axes do.
AxisPositions BlockPath::between(const AxisPositions& from, const AxisPositions& to,
                                 double s) const {
  const AxisPositions axes = mix(from, to, s);
  if (task_.axes.mode(move_.modal) == ProgramMode::axes) return axes;
  const Vector3 tip =
      mix(task_.model.nominal(from, setting_).tip_mm, task_.model.nominal(to, setting_).tip_mm, s);
  return axes_for_tip(task_.model, tip, axes, setting_).value_or(axes);
}

double BlockPath::distance_mm(const Vector3& tip) const {
  Vector3 along, off;
  double length = 0.0, projected = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    along[i] = end_mm_[i] - start_mm_[i];
    off[i] = tip[i] - start_mm_[i];
    length += along[i] * along[i];
    projected += along[i] * off[i];
  }
  const double s = length > 0.0 ? std::clamp(projected / length, 0.0, 1.0) : 0.0;
  return std::hypot(off[0] - s * along[0], off[1] - s * along[1], off[2] - s * along[2]);
}

double BlockPath::deviation_mm(const AxisPositions& from, const AxisPositions& to,
                               double of_interest_mm) const {
  const auto at = [&](double s) {
    return distance_mm(task_.model.actual(between(from, to, s), setting_).tip_mm);
  };
  const double middle = at(0.5);
  return middle < of_interest_mm ? middle : std::max({at(0.25), middle, at(0.75)});
}

double BlockPath::deviation_before_mm(double of_interest_mm) const {
  return deviation_mm(from_.commanded, to_.commanded, of_interest_mm);
}
double BlockPath::deviation_after_mm(double of_interest_mm) const {
  return deviation_mm(from_.written, to_.written, of_interest_mm);
}

BlockPath::Pieces BlockPath::cut(std::size_t count, Tally& tally) const {
  Pieces pieces;
  AxisPositions last = from_.written;
  for (std::size_t j = 1; j < count; ++j) {
    const double s = static_cast<double>(j) / static_cast<double>(count);
    const AxisPositions even = mix(from_.commanded, to_.commanded, s);
    const AxisPositions nominal =
        axes_for_tip(task_.model, tip_at(s), even, setting_).value_or(even);
    const CompensatedPosition position = compensate_position(task_, nominal, setting_);
    if (!is_reached(position, task_.line_of(move_), tally)) return {{}, 0.0, false};
    pieces.words.push_back(
        task_.axes.words(move_.words, to_.commanded, position.axes, move_.modal));
    const AxisPositions written =
        task_.axes.positions(nc::as_written(move_, pieces.words.back(), task_.write), move_.modal)
            .value_or(position.axes);
    pieces.deviation_mm = std::max({pieces.deviation_mm, deviation_mm(last, written),
                                    distance_mm(task_.model.actual(written, setting_).tip_mm)});
    last = written;
  }
  pieces.deviation_mm = std::max(pieces.deviation_mm, deviation_mm(last, to_.written));
  return pieces;
}

std::vector<nc::AxisValues> BlockPath::split(double tolerance_mm, double& deviation_mm,
                                             Tally& tally) const {
  // The deviation of an even curve falls with the square of the number of pieces.
  std::size_t count = 1;
  while (deviation_mm > tolerance_mm) {
    const double factor = std::sqrt(deviation_mm / tolerance_mm);
    const auto more = static_cast<std::size_t>(std::ceil(factor * static_cast<double>(count)));
    count = std::max(count + 1, more);
    if (count > most_pieces) {
      tally.sums.unreachable.push_back(
          {task_.line_of(move_),
           "the tip stays " + std::to_string(1e3 * deviation_mm) +
               " um off the line between the block's ends however often it is cut: ask for a "
               "larger tolerance or more decimals"});
      return {};
    }
    Tally of_pieces;
    Pieces pieces = cut(count, of_pieces);
    deviation_mm = pieces.deviation_mm;
    if (pieces.reached && deviation_mm > tolerance_mm) continue;
    tally.add(of_pieces);
    return std::move(pieces.words);
  }
  return {};
}

}  // namespace trueaxis
