// SPDX-License-Identifier: Apache-2.0
#include "blind/advice.hpp"

#include <algorithm>

namespace trueaxis::blind {
namespace {

// Members of the smallest class that holds the cause, and the advice that would split it; 0: none
// does.
struct Held {
  std::size_t size = 0;
  std::string separator;
};
Held class_of(const Answer& answer, const std::string& id) {
  Held least;
  for (std::size_t k = 0; k < answer.classes.size(); ++k) {
    const std::vector<std::string>& members = answer.classes[k];
    if (std::ranges::find(members, id) == members.end()) continue;
    if (least.size == 0 || members.size() < least.size)
      least = {members.size(), answer.separators[k]};
  }
  return least;
}

}  // namespace

void follow_advice(Result& result, const std::string& command,
                   const std::filesystem::path& folder) {
  const BlindCase& made = result.made;
  if (result.answer.broken() || made.scenario.effects.size() != 1) return;
  const std::string& id = made.scenario.effects.front().id;
  const Held before = class_of(result.answer, id);
  const bool absorbed = made.wanted.kind == Kind::absorbed;
  if (absorbed ? before.size > 0 : before.size < 2) return;
  result.advice_wanted = true;
  const auto own = result.answer.not_observable.find(id);
  if (absorbed && own == result.answer.not_observable.end()) return;
  const std::string plan = absorbed ? own->second : before.separator;
  if (plan.empty()) return;  // it says that no single measurement tells
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
  const std::size_t now = class_of(after, id).size;
  result.advised = after;
  result.advice_resolved = now > 0 && (absorbed || now < before.size);
}

}  // namespace trueaxis::blind
