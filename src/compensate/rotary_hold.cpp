// SPDX-License-Identifier: Apache-2.0
#include "compensate/rotary_hold.hpp"

#include <cmath>
#include <limits>

namespace trueaxis {
namespace {

constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();
constexpr double same_rad = 1e-12;

}  // namespace

RotaryHold::RotaryHold(const CompensationTask& task) {
  if (task.options.rotary == RotaryUse::all) return;
  find_turns(task);
  make_changes(task);
}

void RotaryHold::find_turns(const CompensationTask& task) {
  const auto& moves = task.program.moves;
  if (moves.empty()) return;
  AxisPositions last = task.axes.rotary_start(task.program, moves.front().modal);
  Since since;
  since.fill(never);
  since_.reserve(moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const AxisPositions now = task.axes.rotary_positions(moves[i].words, moves[i].modal);
    for (std::size_t k = 3; k < axis_count; ++k)
      if (std::abs(now[k] - last[k]) > same_rad) since[k - 3] = static_cast<std::uint32_t>(i);
    since_.push_back(since);
    last = now;
  }
}

/// In the order of the program, for what a move changes may go with what one before it has changed.
void RotaryHold::make_changes(const CompensationTask& task) {
  std::vector<bool> is_kept(since_.size());
  for (std::size_t i = 0; i < since_.size(); ++i)
    for (const std::uint32_t turned : since_[i])
      if (turned != never && turned != i) is_kept[turned] = true;
  for (std::size_t i = 0; i < since_.size(); ++i) {
    if (!is_kept[i]) continue;
    const nc::Move& move = task.program.moves[i];
    const auto commanded = task.axes.positions(move.words, move.modal);
    AxisPositions change{};
    if (commanded) {
      const auto position =
          compensate_position(task, *commanded, task.axes.setting(move.modal), of(i));
      for (std::size_t k = 3; k < axis_count; ++k) change[k] = position.axes[k] - (*commanded)[k];
    }
    changes_.emplace(static_cast<std::uint32_t>(i), change);
  }
}

HeldAxes RotaryHold::of(std::size_t i) const {
  HeldAxes held;
  if (since_.empty()) return held;
  for (std::size_t k = 3; k < axis_count; ++k) {
    const std::uint32_t turned = since_[i][k - 3];
    if (turned == i) continue;
    held.hold(k, turned == never ? 0.0 : changes_.at(turned)[k]);
  }
  return held;
}

}  // namespace trueaxis
