// SPDX-License-Identifier: Apache-2.0
#include "compensate/between.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compensate/largest_on_way.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_pieces = 10000;
constexpr int most_rounds = 50;

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
                     const BlockEnd& to, bool same_setting, const HeldAxes& held)
    : task_(task),
      move_(move),
      from_(from),
      to_(to),
      setting_(task.axes.setting(move.modal)),
      same_setting_(same_setting),
      held_(held),
      start_mm_(same_setting ? from.tip_mm : task.model.nominal(from.commanded, setting_).tip_mm),
      end_mm_(to.tip_mm) {}

Vector3 BlockPath::tip_at(double s) const { return mix(start_mm_, end_mm_, s); }

/// From axes to axes, as a control goes: its axes go evenly, or the tip and the rotary axes do.
struct BlockPath::Way {
  AxisPositions from, to;
  bool along_tip = false;
  Vector3 tip_from_mm{}, tip_to_mm{};  ///< nominal, where the tip goes evenly
};

BlockPath::Way BlockPath::way(const AxisPositions& from, const AxisPositions& to) const {
  Way way{from, to, task_.axes.mode(move_.modal) == ProgramMode::tip, {}, {}};
  if (!way.along_tip) return way;
  way.tip_from_mm = task_.model.nominal(from, setting_).tip_mm;
  way.tip_to_mm = task_.model.nominal(to, setting_).tip_mm;
  return way;
}

Vector3 BlockPath::tip_mm(const Way& way, double s, bool nominal) const {
  AxisPositions axes = mix(way.from, way.to, s);
  if (way.along_tip)
    axes = axes_for_tip(task_.model, mix(way.tip_from_mm, way.tip_to_mm, s), axes, setting_)
               .value_or(axes);
  return (nominal ? task_.model.nominal(axes, setting_) : task_.model.actual(axes, setting_))
      .tip_mm;
}

/// How far two points are from each other across the line.
double BlockPath::across_mm(const Vector3& a, const Vector3& b) const {
  return apart_mm(a, b, -INFINITY, INFINITY);
}

double BlockPath::distance_mm(const Vector3& tip) const {
  return apart_mm(tip, start_mm_, 0.0, 1.0);
}

double BlockPath::apart_mm(const Vector3& a, const Vector3& b, double low, double high) const {
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

namespace {

/// In how many parts a way bends no more than once each: 20° of rotary axes and what bends an
/// error.
double parts_of(const AxisPositions& from, const AxisPositions& to, const ErrorBends& bends) {
  constexpr double even_rad = 20.0 * rad_per_deg;
  double parts = 0.0;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const double way = std::abs(to[k] - from[k]);
    parts += way / bends.length[k] + (is_rotary(static_cast<AxisName>(k)) ? way / even_rad : 0.0);
  }
  return parts;
}

/// Eq. 200: how far a way is off the parabola through its ends and middle, at most.
double beside_parabola_mm(const AxisPositions& from, const AxisPositions& to,
                          const ErrorBends& bends) {
  constexpr double lever_mm = 1000.0;
  double turn = 0.0, travel_mm = 0.0, corners_mm = 0.0;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const double way = std::abs(to[k] - from[k]);
    (is_rotary(static_cast<AxisName>(k)) ? turn : travel_mm) += way;
    corners_mm += bends.off_mm(k, from[k], to[k]);
  }
  const double third = turn * turn * (turn * lever_mm + 3.0 * travel_mm);
  return third * std::sqrt(3.0) / 216.0 + corners_mm;
}

}  // namespace

double BlockPath::deviation_mm(const AxisPositions& from, const AxisPositions& to,
                               const Vector3& from_tip_mm, const Vector3& to_tip_mm,
                               double of_interest_mm, bool nominal) const {
  const Way on = way(from, to);
  const double parts = parts_of(from, to, task_.bends);
  const auto looks = 2 * static_cast<std::size_t>(std::ceil(std::clamp(parts, 2.0, 500.0)));
  const bool is_even = parts <= 0.5;
  const double off_from_mm = distance_mm(from_tip_mm), off_to_mm = distance_mm(to_tip_mm);
  Vector3 middle{};
  if (is_even) {
    middle = tip_mm(on, 0.5, nominal);
    const double bow_mm = across_mm(middle, mix(from_tip_mm, to_tip_mm, 0.5));
    const double ends_mm = std::max(off_from_mm, off_to_mm);
    const double seen_mm = std::max(ends_mm, distance_mm(middle));
    const double most_mm = ends_mm + bow_mm + beside_parabola_mm(from, to, task_.bends);
    if (most_mm < of_interest_mm || most_mm <= 1.01 * seen_mm) return seen_mm;
  }
  const auto off_mm = [&](double s) {
    if (s == 0.0) return off_from_mm;
    if (s == 1.0) return off_to_mm;
    return distance_mm(s == 0.5 && is_even ? middle : tip_mm(on, s, nominal));
  };
  return LargestOnWay(off_mm, looks).value(of_interest_mm);
}

double BlockPath::deviation_before_mm(double of_interest_mm) const {
  const auto& from_tip_mm =
      same_setting_ ? from_.actual_mm : task_.model.actual(from_.commanded, setting_).tip_mm;
  return deviation_mm(from_.commanded, to_.commanded, from_tip_mm, to_.actual_mm, of_interest_mm);
}
double BlockPath::deviation_nominal_mm() const {
  return deviation_mm(from_.commanded, to_.commanded, start_mm_, end_mm_, 0.0, true);
}
Vector3 BlockPath::written_from_mm() const {
  return same_setting_ ? from_.written_mm : task_.model.actual(from_.written, setting_).tip_mm;
}
double BlockPath::deviation_after_mm(double of_interest_mm) const {
  return deviation_mm(from_.written, to_.written, written_from_mm(), to_.written_mm,
                      of_interest_mm);
}

BlockPath::Pieces BlockPath::cut(const std::vector<double>& ends, double of_interest_mm,
                                 Tally& tally) const {
  Pieces pieces;
  AxisPositions last = from_.written;
  Vector3 last_mm = written_from_mm();
  for (const double s : ends) {
    if (s >= 1.0) break;
    const AxisPositions even = mix(from_.commanded, to_.commanded, s);
    const AxisPositions nominal =
        axes_for_tip(task_.model, tip_at(s), even, setting_).value_or(even);
    const CompensatedPosition position = compensate_position(task_, nominal, setting_, held_);
    if (!is_reached(position, task_.line_of(move_), tally)) return {{}, {}, false};
    pieces.words.push_back(
        task_.axes.words(move_.words, to_.commanded, position.axes, move_.modal));
    const AxisPositions written =
        task_.axes.positions(nc::as_written(move_, pieces.words.back(), task_.write), move_.modal)
            .value_or(position.axes);
    const Vector3 tip_mm = task_.model.actual(written, setting_).tip_mm;
    pieces.deviation_mm.push_back(deviation_mm(last, written, last_mm, tip_mm, of_interest_mm));
    last = written;
    last_mm = tip_mm;
  }
  pieces.deviation_mm.push_back(
      deviation_mm(last, to_.written, last_mm, to_.written_mm, of_interest_mm));
  return pieces;
}

namespace {

/// Ends of pieces so that each gets the same share of Σ √deviation, where `deviation_mm` is that of
/// pieces that end at `ends`: the deviation of a piece goes with the square of its length.
std::vector<double> evened(const std::vector<double>& ends, const std::vector<double>& deviation_mm,
                           std::size_t count) {
  std::vector<double> reached(ends.size());
  double sum = 0.0;
  const double least = 1e-3 * std::sqrt(*std::ranges::max_element(deviation_mm));
  for (std::size_t j = 0; j < ends.size(); ++j)
    reached[j] = sum += std::max(std::sqrt(deviation_mm[j]), least);
  std::vector<double> out;
  std::size_t j = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const double share = sum * static_cast<double>(k) / static_cast<double>(count);
    while (reached[j] < share) ++j;
    const double from = j == 0 ? 0.0 : ends[j - 1], before = j == 0 ? 0.0 : reached[j - 1];
    out.push_back(from + (ends[j] - from) * (share - before) / (reached[j] - before));
  }
  out.push_back(1.0);
  return out;
}

std::vector<double> equal(std::size_t count) {
  std::vector<double> out;
  for (std::size_t k = 1; k <= count; ++k)
    out.push_back(static_cast<double>(k) / static_cast<double>(count));
  return out;
}

}  // namespace

std::vector<nc::AxisValues> BlockPath::split(double tolerance_mm, double& deviation_mm,
                                             Tally& tally) const {
  if (deviation_mm <= tolerance_mm) return {};
  const bool must_be_equal = move_.modal.feed_mode == nc::FeedMode::inverse_time;
  const double off_at_start_mm = distance_mm(written_from_mm());
  const double off_at_ends_mm = std::max(off_at_start_mm, distance_mm(to_.written_mm));
  std::vector<double> ends{1.0}, deviations_mm{deviation_mm};
  for (int i = 0; i < most_rounds && off_at_ends_mm <= tolerance_mm; ++i) {
    double asked = 0.0;
    for (const double one : deviations_mm)
      asked += std::sqrt((must_be_equal ? deviation_mm : one) / tolerance_mm);
    // Deviations of pieces of another size are a guess: a little more in each round.
    const double pieces_asked = std::ceil((1.0 + 0.01 * i) * asked);
    if (!(pieces_asked <= static_cast<double>(most_pieces))) break;
    const auto count = static_cast<std::size_t>(pieces_asked);
    ends = must_be_equal ? equal(count) : evened(ends, deviations_mm, count);
    Tally of_pieces;
    Pieces pieces = cut(ends, 0.9 * tolerance_mm, of_pieces);
    if (pieces.reached) deviation_mm = *std::ranges::max_element(pieces.deviation_mm);
    if (!pieces.reached || deviation_mm <= tolerance_mm) {
      tally.add(of_pieces);
      return std::move(pieces.words);
    }
    deviations_mm = std::move(pieces.deviation_mm);
  }
  tally.sums.unreachable.push_back(
      {task_.line_of(move_),
       off_at_start_mm > tolerance_mm && !same_setting_
           ? "the tip is " + std::to_string(1e3 * off_at_start_mm) +
                 " um off where the block begins, a place that was compensated under the previous "
                 "work offset: move there by G0 under the new one"
       : off_at_ends_mm > tolerance_mm ? "the tip is " + std::to_string(1e3 * off_at_ends_mm) +
                                             " um off at an end of the block, more than the "
                                             "tolerance: raise the number of decimals"
                                       : "more pieces than " + std::to_string(most_pieces) +
                                             " would be needed for the tolerance"});
  return {};
}

}  // namespace trueaxis
