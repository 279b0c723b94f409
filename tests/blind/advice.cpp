// SPDX-License-Identifier: Apache-2.0
#include "blind/advice.hpp"

#include <algorithm>

namespace trueaxis::blind {
namespace {

// Members of the smallest class that holds the cause; 0: none does.
std::size_t class_size(const Answer& answer, const std::string& id) {
  std::size_t least = 0;
  for (const std::vector<std::string>& members : answer.classes) {
    if (std::ranges::find(members, id) == members.end()) continue;
    if (least == 0 || members.size() < least) least = members.size();
  }
  return least;
}

}  // namespace

void follow_advice(Result& result, const std::string& command,
                   const std::filesystem::path& folder) {
  const BlindCase& made = result.made;
  if (result.answer.broken() || made.scenario.effects.size() != 1) return;
  const std::string& id = made.scenario.effects.front().id;
  const std::size_t before = class_size(result.answer, id);
  const bool absorbed = made.wanted.kind == Kind::absorbed;
  if (absorbed ? before > 0 : before < 2) return;
  const auto own = result.answer.not_observable.find(id);
  if (absorbed && own == result.answer.not_observable.end()) return;
  const std::string plan = absorbed ? own->second : result.answer.next_plan;
  const auto extended = with_measurement(made.scenario, plan);
  if (!extended) return;
  result.advice = plan;
  BlindCase further = made;
  further.scenario = *extended;
  further.rows.clear();
  const std::filesystem::path next = folder / "advised";
  write_sealed(further, next);
  const Answer after = run_command(command, next, made.wanted.surface);
  result.advice_taken = true;
  const std::size_t now = class_size(after, id);
  result.advice_resolved = now > 0 && (absorbed || now < before);
}

}  // namespace trueaxis::blind
