// SPDX-License-Identifier: Apache-2.0
#include "calibrate/files/edge_json.hpp"
#include "job/machine/files/machine_job_files.hpp"

namespace trueaxis {

Json harm_object(const ProgramHarm& harm) {
  const auto largest = [](const LargestInProgram& one) {
    return at_line(mm_json(one.value), one.line);
  };
  const auto effect = [&](const EffectOnProgram& one) -> Json {
    return {{"effect", one.effect},
            {"found", one.found},
            {"size", edge_size(one.size, one.unit)},
            {"tip", largest(one.tip)}};
  };
  const auto plan = [&](const PlanOnProgram& one) -> Json {
    return {{"plan", one.plan}, {"U_without_place_of_part", largest(one.U)}};
  };
  return {{"file", harm.file},
          {"blocks", harm.blocks},
          {"by_effect", list_of(harm.effects, effect)},
          {"U_without_place_of_part", largest(harm.U)},
          {"coverage_factor", number(harm.coverage_factor)},
          {"plans", list_of(harm.plans, plan)}};
}

}  // namespace trueaxis
