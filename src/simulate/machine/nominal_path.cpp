// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/nominal_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>

#include "math/golden_section.hpp"
#include "simulate/machine/tool_in_part.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_machine {
namespace {

/// The distance of tips, and of directions at 100 mm.
double apart_mm(const ToolInPart& a, const ToolInPart& b) {
  constexpr double lever_mm = 100.0;
  return distance_mm(a.tip_mm, b.tip_mm) + lever_mm * distance_mm(a.direction, b.direction);
}

/// From the straight line between two points.
double off_line_mm(const Vector3& point, const Vector3& from, const Vector3& to) {
  double along = 0.0, length = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (point[i] - from[i]) * (to[i] - from[i]);
    length += (to[i] - from[i]) * (to[i] - from[i]);
  }
  const double share = length > 0.0 ? std::fmin(std::fmax(along / length, 0.0), 1.0) : 0.0;
  Vector3 foot;
  for (std::size_t i = 0; i < 3; ++i) foot[i] = std::lerp(from[i], to[i], share);
  return distance_mm(point, foot);
}

/// On an arc, or with axes that go evenly.
Vector3 tip_on_way(const Machine& machine, const ControlMove& move, double share) {
  if (!move.along_tip)
    return tool_in_part(machine, {}, axes_on_way(machine, move, share), move.setting).tip_mm;
  const Vector3 from = tool_in_part(machine, {}, move.from, move.setting).tip_mm,
                to = tool_in_part(machine, {}, move.to, move.setting).tip_mm;
  Vector3 there;
  for (std::size_t i = 0; i < 3; ++i) there[i] = std::lerp(from[i], to[i], share);
  return move.arc->put_on_arc(there, from, to, share);
}

constexpr double part_rad = 5.0 * rad_per_deg;
constexpr std::size_t fewest_parts = 64;
constexpr double beyond_any_mm = 1e9;

/// What of a block is not a position: its words except those of axes, F and its mode (a turn may
/// have its time instead), with G1 for an arc. Empty for a line of axis words.
std::string other_words(const BlockWords& block) {
  std::string text;
  for (const double code : block.g)
    if (code != 93.0 && code != 94.0)
      text += fmt::format("G{} ", code == 2.0 || code == 3.0 ? 1.0 : code);
  for (const double code : block.m) text += fmt::format("M{} ", code);
  for (const auto& [letter, value] : block.of_letter)
    if (std::string_view("XYZABCFIJKR").find(letter) == std::string_view::npos)
      text += fmt::format("{}{} ", letter, value);
  return text;
}

/// Takes the blocks of the nominal program one after the other.
class Pairing {
 public:
  Pairing(const Machine& machine, const ErrorModel& errors, std::span<const ControlMove> moves,
          std::span<const ControlMove> nominal)
      : machine_(machine), errors_(errors), moves_(moves), nominal_(nominal) {
    for (const ControlMove& move : moves) {
      ends_.push_back(tool_in_part(machine, errors, move.to, move.setting));
      others_.push_back(other_words(move.words));
    }
    for (const ControlMove& move : nominal)
      nominal_ends_.push_back(tool_in_part(machine, {}, move.to, move.setting));
    // For each move the next that says the same, with lines of axis words alone between.
    next_alike_.assign(moves.size(), moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
      std::size_t next = i + 1;
      while (next < moves.size() && others_[next].empty() && !others_[i].empty()) ++next;
      if (next < moves.size() && others_[next] == others_[i]) next_alike_[i] = next;
    }
  }

  /// How many blocks were met.
  std::size_t pair(std::vector<std::size_t>& out) const {
    std::size_t j = 0, first = 0;  // `first` of the moves of block j
    for (std::size_t i = 0; i < moves_.size() && j < nominal_.size(); ++i) {
      out[i] = j;
      if (!ends(first, i, j)) continue;
      ++j;
      first = i + 1;
    }
    return j;
  }

 private:
  bool ends(std::size_t first, std::size_t i, std::size_t j) const {
    if (moves_.size() - i == nominal_.size() - j || i + 1 == moves_.size()) return true;
    if (others_[i] != other_words(nominal_[j].words) || j + 1 == nominal_.size()) return false;
    const std::size_t next = next_alike_[i];
    return next == moves_.size() || left(first, i, j) <= left(first, next, j);
  }

  /// How far move i ends from the end of block j, mm. A whole turn ends where it begins: the first
  /// half of an arc counts as further away than anything.
  double left(std::size_t first, std::size_t i, std::size_t j) const {
    const double apart = apart_mm(ends_[i], nominal_ends_[j]);
    if (!nominal_[j].arc) return apart;
    const ArcWay& arc = *nominal_[j].arc;
    const auto from_centre = [&](const AxisPositions& axes, const ToolInPart& tool) {
      const Vector3 at = nominal_[j].along_tip ? tool.tip_mm : Vector3{axes[0], axes[1], axes[2]};
      return arc.in_plane(at) - arc.centre_mm;
    };
    double turned = 0.0;
    for (std::size_t k = first; k <= i; ++k) {
      const ToolInPart start = tool_in_part(machine_, errors_, moves_[k].from, moves_[k].setting);
      turned += std::arg(from_centre(moves_[k].to, ends_[k]) / from_centre(moves_[k].from, start));
    }
    const double left_rad = std::abs(arc.turn_rad - turned);
    return left_rad > 0.5 * std::abs(arc.turn_rad) ? (1.0 + left_rad) * beyond_any_mm : apart;
  }

  const Machine& machine_;
  const ErrorModel& errors_;
  std::span<const ControlMove> moves_, nominal_;
  std::vector<ToolInPart> ends_, nominal_ends_;
  std::vector<std::string> others_;
  std::vector<std::size_t> next_alike_;
};

}  // namespace

NominalPath::NominalPath(const Machine& machine, const ControlMove& move)
    : machine_(&machine), move_(&move) {
  double turn_rad = 0.0, travel_mm = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    travel_mm = std::fmax(travel_mm, std::fabs(move.to[k] - move.from[k]));
    turn_rad = std::fmax(turn_rad, std::fabs(move.to[k + 3] - move.from[k + 3]));
  }
  const bool by_axes = !move.along_tip && turn_rad > (travel_mm < 1e-9 ? 0.0 : 20.0 * rad_per_deg);
  if (!move.arc && !by_axes) {
    for (const AxisPositions& axes : {move.from, move.to})
      tips_mm_.push_back(tool_in_part(machine, {}, axes, move.setting).tip_mm);
    return;
  }
  const auto parts = std::max(fewest_parts, static_cast<std::size_t>(turn_rad / part_rad));
  for (std::size_t i = 0; i <= parts; ++i)
    tips_mm_.push_back(
        tip_on_way(machine, move, static_cast<double>(i) / static_cast<double>(parts)));
}

double NominalPath::off_mm(const Vector3& tip_mm) const {
  if (tips_mm_.size() == 2) return off_line_mm(tip_mm, tips_mm_.front(), tips_mm_.back());
  const std::size_t last = tips_mm_.size() - 1;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < tips_mm_.size(); ++i)
    if (distance_mm(tip_mm, tips_mm_[i]) < distance_mm(tip_mm, tips_mm_[nearest])) nearest = i;
  // A whole turn begins where it ends.
  const bool at_an_end = nearest == 0 || nearest == last;
  return at_an_end ? std::fmin(off_beside_mm(tip_mm, 0), off_beside_mm(tip_mm, last))
                   : off_beside_mm(tip_mm, nearest);
}

/// The foot of the perpendicular lies next to the nearest point.
double NominalPath::off_beside_mm(const Vector3& tip_mm, std::size_t nearest) const {
  const std::size_t last = tips_mm_.size() - 1;
  const auto parts = static_cast<double>(last);
  const double low = static_cast<double>(nearest == 0 ? 0 : nearest - 1) / parts,
               high = static_cast<double>(std::min(nearest + 1, last)) / parts;
  const auto near_at = [&](double share) {
    return -distance_mm(tip_mm, tip_on_way(*machine_, *move_, share));
  };
  return -golden_section(near_at, low, high, 25).largest;  // to 6e-6 of the range
}

Vector3 lead_of(const Machine& machine, const ControlMove& move) {
  if (move.along_tip) return tool_in_part(machine, {}, move.from, move.setting).tip_mm;
  return {move.from[0], move.from[1], move.from[2]};
}

std::vector<std::size_t> nominal_moves_of(const Machine& machine, const ErrorModel& errors,
                                          std::span<const ControlMove> moves,
                                          std::span<const ControlMove> nominal,
                                          const std::string& file) {
  std::vector<std::size_t> out(moves.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  if (moves.size() == nominal.size()) return out;
  const std::size_t met = moves.size() < nominal.size()
                              ? moves.size()
                              : Pairing(machine, errors, moves, nominal).pair(out);
  if (met != nominal.size())
    throw InputError(file, "is not another form of the nominal program: it matches only " +
                               std::to_string(met) + " of its " + std::to_string(nominal.size()) +
                               " moves");
  return out;
}

}  // namespace trueaxis::virtual_machine
