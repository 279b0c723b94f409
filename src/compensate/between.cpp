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
constexpr double most_parts = 1e5;  // lengths over which the errors bend that are looked at
constexpr int most_rounds = 50, even_rounds = 10;

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
      nominal_(task, move, from.commanded,
               same_setting ? from.tip_mm : task.model.nominal(from.commanded, setting_).tip_mm,
               to) {}

/// From axes to axes, as a control goes: its axes go evenly, or the tip and the rotary axes do.
class BlockPath::ControlWay {
 public:
  ControlWay(const BlockPath& path, const Stretch& on)
      : path_(path),
        on_(on),
        along_tip_(path.task_.axes.mode(path.move_.modal) == ProgramMode::tip) {
    if (!along_tip_) return;
    tip_from_mm_ = path.task_.model.nominal(on.from, path.setting_).tip_mm;
    tip_to_mm_ = path.task_.model.nominal(on.to, path.setting_).tip_mm;
  }
  AxisPositions axes_at(double s) const {
    if (on_.motion == Motion::arc) return path_.nominal_.axes_at(s);
    AxisPositions axes = mix(on_.from, on_.to, s);
    if (!along_tip_) return axes;
    return axes_for_tip(path_.task_.model, mix(tip_from_mm_, tip_to_mm_, s), axes, path_.setting_)
        .value_or(axes);
  }

 private:
  const BlockPath& path_;
  const Stretch& on_;
  bool along_tip_;
  Vector3 tip_from_mm_{}, tip_to_mm_{};  ///< nominal, where the tip goes evenly
};

namespace {

/// In how many parts a way bends no more than once each: 20° of rotary axes and what bends an
/// error.
double parts_of(const AxisPositions& from, const AxisPositions& to, const ErrorBends& bends) {
  double parts = 0.0;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const double way = std::abs(to[k] - from[k]);
    parts +=
        way / bends.length[k] + (is_rotary(static_cast<AxisName>(k)) ? way / even_turn_rad : 0.0);
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

double BlockPath::deviation_mm(const Stretch& on, double of_interest_mm) const {
  const ControlWay way(*this, on);
  const auto tip_mm = [&](double s) {
    const AxisPositions axes = way.axes_at(s);
    return (on.motion == Motion::nominal ? task_.model.nominal(axes, setting_)
                                         : task_.model.actual(axes, setting_))
        .tip_mm;
  };
  const auto off_nominal_mm = [&](const Vector3& tip, double s) {
    return nominal_.distance_mm(tip, std::lerp(on.begin, on.end, s));
  };
  const double parts = parts_of(on.from, on.to, task_.bends);
  const auto looks = 2 * static_cast<std::size_t>(std::ceil(std::clamp(parts, 2.0, most_parts)));
  const bool is_even = parts <= 0.5 && !nominal_.is_curve();
  const double off_from_mm = off_nominal_mm(on.from_tip_mm, 0.0),
               off_to_mm = off_nominal_mm(on.to_tip_mm, 1.0);
  Vector3 middle{};
  if (is_even) {
    middle = tip_mm(0.5);
    const double bow_mm = nominal_.across_mm(middle, mix(on.from_tip_mm, on.to_tip_mm, 0.5));
    const double ends_mm = std::max(off_from_mm, off_to_mm);
    const double seen_mm = std::max(ends_mm, off_nominal_mm(middle, 0.5));
    const double most_mm = ends_mm + bow_mm + beside_parabola_mm(on.from, on.to, task_.bends);
    if (most_mm < of_interest_mm || most_mm <= stated_to * seen_mm) return seen_mm;
  }
  const auto off_mm = [&](double s) {
    if (s == 0.0) return off_from_mm;
    if (s == 1.0) return off_to_mm;
    return off_nominal_mm(s == 0.5 && is_even ? middle : tip_mm(s), s);
  };
  return LargestOnWay(off_mm, looks).value(of_interest_mm);
}

double BlockPath::deviation_before_mm(double of_interest_mm) const {
  const auto& from_tip_mm =
      same_setting_ ? from_.actual_mm : task_.model.actual(from_.commanded, setting_).tip_mm;
  return deviation_mm({from_.commanded, to_.commanded, from_tip_mm, to_.actual_mm,
                       nominal_.is_arc() ? Motion::arc : Motion::even},
                      of_interest_mm);
}
double BlockPath::deviation_nominal_mm() const {
  return deviation_mm(
      {from_.commanded, to_.commanded, nominal_.start_mm(), nominal_.end_mm(), Motion::nominal},
      0.0);
}
Vector3 BlockPath::written_from_mm() const {
  return same_setting_ ? from_.written_mm : task_.model.actual(from_.written, setting_).tip_mm;
}
double BlockPath::deviation_after_mm(double of_interest_mm) const {
  return deviation_mm({from_.written, to_.written, written_from_mm(), to_.written_mm},
                      of_interest_mm);
}

BlockPath::Pieces BlockPath::cut(const std::vector<double>& ends, double of_interest_mm,
                                 Tally& tally) const {
  Pieces pieces;
  Stretch piece{from_.written, to_.written, written_from_mm(), to_.written_mm};
  for (const double s : ends) {
    piece.end = s;
    if (s >= 1.0) break;
    const CompensatedPosition position =
        compensate_position(task_, nominal_.axes_at(s), setting_, held_);
    if (!is_reached(position, task_.line_of(move_), tally)) return {{}, {}, false};
    pieces.words.push_back(
        task_.axes.words(move_.words, to_.commanded, position.axes, move_.modal));
    piece.to =
        task_.axes.positions(nc::as_written(move_, pieces.words.back(), task_.write), move_.modal)
            .value_or(position.axes);
    piece.to_tip_mm = task_.model.actual(piece.to, setting_).tip_mm;
    pieces.deviation_mm.push_back(deviation_mm(piece, of_interest_mm));
    piece.from = piece.to;
    piece.from_tip_mm = piece.to_tip_mm;
    piece.begin = s;
  }
  piece.to = to_.written;
  piece.to_tip_mm = to_.written_mm;
  pieces.deviation_mm.push_back(deviation_mm(piece, of_interest_mm));
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

/// The pieces that are beyond the tolerance in two: what bends at corners, as between the places of
/// a table, is not evened out.
std::vector<double> halved(const std::vector<double>& ends, const std::vector<double>& deviation_mm,
                           double tolerance_mm) {
  std::vector<double> out;
  for (std::size_t j = 0; j < ends.size(); ++j) {
    const double from = j == 0 ? 0.0 : ends[j - 1];
    if (deviation_mm[j] > tolerance_mm) out.push_back(0.5 * (from + ends[j]));
    out.push_back(ends[j]);
  }
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
  const double off_at_start_mm = nominal_.distance_mm(written_from_mm(), 0.0);
  const double off_at_ends_mm =
      std::max(off_at_start_mm, nominal_.distance_mm(to_.written_mm, 1.0));
  std::vector<double> ends{1.0}, deviations_mm{deviation_mm};
  for (int i = 0; i < most_rounds && off_at_ends_mm <= tolerance_mm; ++i) {
    if (i >= even_rounds && !must_be_equal) {
      ends = halved(ends, deviations_mm, tolerance_mm);
    } else {
      double asked = 0.0;
      for (const double one : deviations_mm)
        asked += std::sqrt((must_be_equal ? deviation_mm : one) / tolerance_mm);
      // Deviations of pieces of another size are a guess: a little more in each round.
      const double pieces_asked = std::ceil((1.0 + 0.01 * i) * asked);
      if (!(pieces_asked <= static_cast<double>(most_pieces))) break;
      const auto count = static_cast<std::size_t>(pieces_asked);
      ends = must_be_equal ? equal(count) : evened(ends, deviations_mm, count);
    }
    if (ends.size() > most_pieces) break;
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
