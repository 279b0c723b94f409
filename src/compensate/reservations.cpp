// SPDX-License-Identifier: Apache-2.0
#include "compensate/reservations.hpp"

namespace trueaxis {
namespace {

/// How many of the moves it is, and the line of the first.
template <class Is>
void add_moves(Reasons& reasons, ReasonCode code, const std::vector<nc::Move>& moves,
               const Is& is) {
  double count = 0.0, line = 0.0;
  for (const nc::Move& move : moves)
    if (is(move) && ++count == 1.0) line = move.line + 1.0;
  if (count > 0.0) reasons.push_back({code, {}, {{"moves", count}, {"line", line}}});
}

}  // namespace

Reasons reservations_of(const nc::Program& program, const CompensationOptions& options,
                        const ProgramCompensation& result) {
  Reasons reasons;
  add_moves(reasons, ReasonCode::rapids_not_counted, program.unknown_rapids,
            [](const nc::Move&) { return true; });
  add_moves(reasons, ReasonCode::ways_not_counted, program.moves, [](const nc::Move& move) {
    return !move.continues && move.modal.motion != nc::Motion::rapid;
  });
  if (!result.unreachable.empty() || !result.direction_comes_out_worse()) return reasons;
  const LargestInProgram &after = result.after.direction, &before = result.before.direction;
  Reason worse{ReasonCode::direction_worse,
               {},
               {{"after", after.value, "rad"},
                {"before", before.value, "rad"},
                {"line", static_cast<double>(after.line)}}};
  if (options.rotary == RotaryUse::moved) worse.remedies = {{ReasonCode::correct_all_rotary}};
  reasons.push_back(std::move(worse));
  return reasons;
}

}  // namespace trueaxis
