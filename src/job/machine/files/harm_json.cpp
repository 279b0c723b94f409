// SPDX-License-Identifier: Apache-2.0
#include "calibrate/files/edge_json.hpp"
#include "job/machine/files/harm_files.hpp"

namespace trueaxis {
namespace {

Json at_line(const LargestInProgram& largest) {
  Json json = with_unit(largest.value, "mm");
  json["line"] = largest.line == 0 ? Json(nullptr) : Json(largest.line);
  return json;
}

}  // namespace

Json harm_object(const ProgramHarm& harm) {
  Json effects = Json::array(), plans = Json::array();
  for (const EffectOnProgram& one : harm.effects)
    effects.push_back({{"effect", one.effect},
                       {"found", one.found},
                       {"size", edge_size(one.size, one.unit)},
                       {"tip", at_line(one.tip)}});
  for (const PlanOnProgram& one : harm.plans)
    plans.push_back({{"plan", one.plan}, {"U_without_place_of_part", at_line(one.U)}});
  return {{"file", harm.file},
          {"blocks", harm.blocks},
          {"by_effect", effects},
          {"U_without_place_of_part", at_line(harm.U)},
          {"coverage_factor", number(harm.coverage_factor)},
          {"plans", plans}};
}

}  // namespace trueaxis
