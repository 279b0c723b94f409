// SPDX-License-Identifier: Apache-2.0
#include "format/json.hpp"
#include "study/planning/files/planning_files.hpp"

namespace trueaxis {
namespace {

using namespace study;

Json plan_json(const PlannedMeasurement& plan) {
  Json json;
  for (const Choice choice : choices)
    json[info_of(choice).name] = with_unit(plan.of(choice), info_of(choice).unit);
  json["U"] = with_unit(plan.u_expanded_mm, "mm");
  json["time"] = with_unit(plan.time_s, "s");
  json["rate"] = with_unit(plan.rate_hz, "Hz");
  json["readings"] = plan.readings;
  return json;
}

Json confirmed_json(const Confirmation& confirmed) {
  return {{"repeats", confirmed.repeats},
          {"failures", confirmed.failures},
          {"U",
           {{"value", number(confirmed.u_expanded_mm)},
            {"unit", "mm"},
            {"interval_95",
             {number(confirmed.interval_95_mm.low), number(confirmed.interval_95_mm.high)}}}},
          {"U_stated", with_unit(confirmed.stated_mm, "mm")},
          {"at_bound", confirmed.at_bound},
          {"misses", confirmed.misses},
          {"states_more", confirmed.states_more}};
}

Json recommendation_json(const Recommendation& one) {
  return {{"what", one.what},
          {"plan", plan_json(one.plan)},
          {"confirmed", confirmed_json(one.confirmed)}};
}

Json variable_json(const DesignVariable& one) {
  const ChoiceInfo& info = info_of(one.choice);
  return {{"choice", info.name},
          {"low", with_unit(one.low, info.unit)},
          {"high", with_unit(one.high, info.unit)}};
}

Json alone_json(const Alone& one) {
  return {{"choice", info_of(one.choice).name},
          {"reached", one.reached},
          {"plan", plan_json(one.plan)}};
}

Json table_row_json(const TableRow& row) {
  return {{"reached", row.reached}, {"plan", plan_json(row.plan)}};
}

}  // namespace

std::string planning_json(const PlanningTask& task, const PlanningAnswer& answer,
                          const std::string& input_hash) {
  Json json{{"schema", "trueaxis.plan/1"},
            {"version", TRUEAXIS_VERSION},
            {"input_hash", input_hash},
            {"status", !answer.reached    ? "not_reached"
                       : answer.confirmed ? "reached"
                                          : "not_confirmed"},
            {"of", task.base.part.kind == virtual_lathe::PartKind::face ? "face" : "axis"},
            {"goal", with_unit(task.goal_mm, "mm")},
            {"coverage_factor", task.coverage_factor},
            {"seed", task.seed},
            {"repeats", task.repeats}};
  json["rate_limit"] = task.rate_hz ? with_unit(*task.rate_hz, "Hz") : Json(nullptr);
  json["time_limit"] = task.time_s ? with_unit(*task.time_s, "s") : Json(nullptr);
  json["free"] = list_of(task.variables, variable_json);
  json["as_given"] = plan_json(answer.as_given);
  json["nearest"] = plan_json(answer.nearest);
  json["alone"] = list_of(answer.alone, alone_json);
  json["solved_for"] = info_of(answer.solved_for).name;
  json["table"] = list_of(answer.table, table_row_json);
  json["recommended"] = list_of(answer.recommended, recommendation_json);
  json["not_confirmed"] = list_of(answer.not_confirmed, recommendation_json);
  json["remarks"] = answer.remarks;
  return json_text(json);
}

}  // namespace trueaxis
