// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "calibrate/files/edge_json.hpp"
#include "calibrate/files/machine_diagnosis_files.hpp"
#include "infer/files/inference_json.hpp"

namespace trueaxis {
namespace {

Json linear_json(const std::vector<CalibratedParameter>& parameters, const Covariance& covariance) {
  std::vector<LinearValue> values;
  for (const CalibratedParameter& one : parameters)
    values.push_back({one.name, one.estimate.value, one.estimate.unit});
  Json json;
  add_linear(json, values, covariance);
  return json;
}

Json term_json(const MachineFinding& finding) {
  Json json = linear_json(finding.parameters, finding.covariance);
  json["formula"] = finding.cause.formula;
  json["shape"] = Json::object();
  for (const MachineShape& one : finding.cause.shape)
    json["shape"][one.name] = edge_size(one.value, one.unit);
  return json;
}

Json finding_json(const MachineFinding& finding) {
  Json json = finding_object(finding.effect(), finding, parameters_json(finding.parameters));
  json["size"] = edge_size(finding.size, finding.cause.unit);
  json["alias"] = finding.alias;
  json["pairs"] = finding.pairs;
  add_rivals(json, finding);
  json["separate_with"] = finding.separate_with && !finding.separate_with->plan.empty()
                              ? Json(finding.separate_with->plan)
                              : Json(nullptr);
  json["term"] = term_json(finding);
  return json;
}

/// The alternatives of `MachineTerm`, in their order.
const Json kinds_of_term[] = {nullptr,     "position",   "sense",     "tip_drift",
                              "ball_step", "zero_drift", "zero_step", "zero_scale"};
static_assert(std::variant_size_v<MachineTerm> == std::size(kinds_of_term));

/// The meaning of each id of the catalogue, so that nobody takes an id apart: its kind is the
/// term that it is, its axis that which it is a function of.
Json effects_json(const MachineDiagnosis& d) {
  Json json = Json::object();
  for (const MachineEffect& effect : d.effects) {
    const auto axis = axis_of(effect.term);
    const auto* error = std::get_if<ErrorOfPosition>(&effect.term);
    json[effect.id] = {{"title", effect.title},
                       {"kind", kinds_of_term[effect.term.index()]},
                       {"axis", axis ? Json(std::string(1, letter_of(*axis))) : Json(nullptr)},
                       {"error", error ? Json(to_string(error->error)) : Json(nullptr)}};
  }
  return json;
}

/// What follows from each cause that was found.
Json consequences_json(const MachineDiagnosis& d) {
  Json json = Json::object();
  for (const MachineFinding& finding : d.findings)
    if (!finding.cause.consequence.empty()) json[finding.effect()] = finding.cause.consequence;
  return json;
}

Json unexplained_json(const MachineUnexplained& one) {
  return {{"pattern", one.pattern},
          {"amplitude", to_json(one.amplitude)},
          {"left", number(at_edge({one.left, 0.0, one.amplitude.unit, ""}).value)},
          {"p_value", number(one.p_value)},
          {"term", linear_json(one.parameters, one.covariance)}};
}

Json not_observable_json(const MachineNotObservable& one) {
  return {{"effect", one.effect},
          {"why", one.why},
          {"detectable", detectable_object(one)},
          {"separate_with", one.plans()}};
}

Json plan_json(const MachinePlan& plan) {
  return {{"plan", plan.code},
          {"what", plan.what},
          {"minutes", number(plan.minutes)},
          {"shows", plan.shows},
          {"separates", plan.separates}};
}

/// Where to go: a table with the columns of a measurement, and where the balls are.
Json measurement_json(const MachinePlan& plan, const Machine& machine) {
  if (plan.axis) {
    const double unit = is_rotary(*plan.axis) ? rad_per_deg : 1.0;
    Json rows = Json::array();
    for (const PlannedVisit& visit : plan.visits)
      rows.push_back(Json::array({number(visit.axes[index_of(*plan.axis)] / unit)}));
    return {{"columns", Json::array({is_rotary(*plan.axis) ? "command[deg]" : "command[mm]"})},
            {"balls", Json::array()},
            {"rows", rows}};
  }
  Json columns{"setup", "ball"}, rows = Json::array(), balls = Json::array();
  std::vector<std::size_t> axes;
  for (std::size_t k = 0; k < axis_count; ++k)
    if (machine.find(static_cast<AxisName>(k)) != nullptr) axes.push_back(k);
  for (const std::size_t k : axes)
    columns.push_back(std::string(1, "XYZABC"[k]) + (k < 3 ? "[mm]" : "[deg]"));
  columns.push_back("tool_length[mm]");
  std::set<std::pair<int, int>> placed;
  for (const PlannedVisit& visit : plan.visits) {
    if (placed.insert({visit.setup, visit.ball}).second)
      balls.push_back({{"setup", visit.setup}, {"ball", visit.ball}, {"centre_mm", visit.ball_mm}});
    Json row{visit.setup, visit.ball};
    for (const std::size_t k : axes)
      row.push_back(number(visit.axes[k] / (k < 3 ? 1.0 : rad_per_deg)));
    row.push_back(number(visit.tool_length_mm));
    rows.push_back(row);
  }
  return {{"columns", columns}, {"balls", balls}, {"rows", rows}};
}

Json next_json(const MachineDiagnosis& d, const Machine& machine) {
  const MachinePlan* plan = d.next();
  if (plan == nullptr)
    return {{"plan", ""}, {"why_not", "no plan shows or separates any further error"}};
  Json json = plan_json(*plan);
  json["measurement"] = measurement_json(*plan, machine);
  return json;
}

Json gain_json(const MachineDiagnosis& d) {
  Json json = explained_object(d.gain);
  json["blocks"] =
      std::to_string(d.blocks) + " blocks of " + (d.of_read_outs() ? "" : "rotary ") + "positions";
  return json;
}

Json options_json(const MachineDiagnosis& d) {
  return {{"false_alarm", number(d.false_alarm)},
          {"coverage_factor", number(d.baseline.coverage_factor)},
          {"typical_length", with_unit(d.typical_length_mm, "mm")},
          {"typical_angle", with_unit(d.typical_angle_rad / rad_per_deg, "deg")}};
}

Json baseline_json(const Calibration& c) {
  return {{"converged", c.converged},
          {"parameters", parameters_json(c.parameters)},
          {"not_determined", not_determined_json(c)},
          {"gauge", c.gauge},
          {"equations", c.equations},
          {"unknowns", c.unknowns}};
}

}  // namespace

std::string machine_diagnosis_json(const MachineDiagnosis& d, const Machine& machine) {
  return json_text(machine_diagnosis_object(d, machine));
}

Json machine_diagnosis_object(const MachineDiagnosis& d, const Machine& machine) {
  Json json{
      {"schema", "trueaxis.machine_diagnosis/2"},
      {"version", TRUEAXIS_VERSION},
      {"machine", machine.name},
      {"inputs", inputs_json(d.baseline)},
      {"options", options_json(d)},
      {"verdict", to_string(d.verdict)},
      {"consequences", consequences_json(d)},
      {"effects", effects_json(d)},
      {"baseline", baseline_json(d.baseline)},
      {"extended", {{"parameters", parameters_json(d.extended)}}},
      {"findings", list_of(d.findings, finding_json)},
      {"unexplained", list_of(d.unexplained, unexplained_json)},
      {"not_observable", list_of(d.not_observable, not_observable_json)},
      {"remarks", d.remarks},
      {"checks", list_of(d.checks, check_object)},
      {"noise", {{"sigma", with_unit(d.noise_mm, "mm")}, {"source", "residuals of the final fit"}}},
      {"gain", gain_json(d)},
      {"next_measurement", next_json(d, machine)},
      {"plans", list_of(d.plans, plan_json)}};
  add_tests(json, d);
  return json;
}

}  // namespace trueaxis
