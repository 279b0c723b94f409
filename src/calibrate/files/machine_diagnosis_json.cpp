// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <set>

#include "calibrate/files/edge_json.hpp"
#include "calibrate/files/machine_diagnosis_files.hpp"

namespace trueaxis {
namespace {

Json rival_json(const Rival& rival) {
  return {{"effect", rival.effect},
          {"distance", number(rival.distance)},
          {"likelihood_ratio", number(rival.likelihood_ratio)},
          {"probability", number(rival.probability)},
          {"structural", rival.structural}};
}

/// The covariance in the units of `linear`.
Json linear_json(const std::vector<CalibratedParameter>& parameters, const Covariance& covariance) {
  Json linear = Json::array(), rows = Json::array();
  const auto to_edge = [&](std::size_t i) { return edge_factor(parameters[i].estimate.unit); };
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    Json one = edge_size(parameters[i].estimate.value, parameters[i].estimate.unit);
    one["name"] = parameters[i].name;
    linear.push_back(one);
    Json row = Json::array();
    for (std::size_t j = 0; j < parameters.size(); ++j)
      row.push_back(number(to_edge(i) * to_edge(j) * covariance(i, j)));
    rows.push_back(row);
  }
  return {{"linear", linear}, {"covariance", rows}};
}

Json term_json(const MachineFinding& finding) {
  Json json = linear_json(finding.parameters, finding.covariance);
  json["formula"] = finding.formula;
  json["shape"] = Json::object();
  for (const MachineShape& one : finding.shape)
    json["shape"][one.name] = edge_size(one.value, one.unit);
  return json;
}

Json finding_json(const MachineFinding& finding) {
  const std::string unit = finding.parameters.front().estimate.unit;
  return {{"effect", finding.effect},
          {"term", term_json(finding)},
          {"alias", finding.alias},
          {"pairs", finding.pairs},
          {"class", finding.members()},
          {"parameters", parameters_json(finding.parameters)},
          {"size", edge_size(finding.size, unit)},
          {"p_value", number(finding.p_value)},
          {"probability", number(finding.probability)},
          {"rms", with_unit(finding.rms_mm, "mm")},
          {"rivals", list_of(finding.rivals, rival_json)},
          {"separate_with", finding.separate_with && !finding.separate_with->plan.empty()
                                ? Json(finding.separate_with->plan)
                                : Json(nullptr)}};
}

/// What follows from each cause that was found.
Json consequences_json(const MachineDiagnosis& d) {
  Json json = Json::object();
  for (const MachineFinding& finding : d.findings)
    if (!finding.consequence.empty()) json[finding.effect] = finding.consequence;
  return json;
}

Json unexplained_json(const MachineUnexplained& one) {
  return {{"pattern", one.pattern},
          {"amplitude", to_json(one.amplitude)},
          {"p_value", number(one.p_value)},
          {"term", linear_json(one.parameters, one.covariance)}};
}

Json not_observable_json(const MachineNotObservable& one) {
  Json detectable;
  if (std::isfinite(one.detectable))
    detectable = edge_size(one.detectable, one.detectable_unit);
  else
    detectable = {{"value", nullptr},
                  {"unit", one.detectable_unit == "rad" ? "deg" : "mm"},
                  {"why", "no size of it would be found"}};
  return {{"effect", one.effect},
          {"why", one.why},
          {"detectable", detectable},
          {"separate_with", one.plans()}};
}

Json plan_json(const MachinePlan& plan) {
  return {{"plan", plan.code},
          {"what", plan.what},
          {"minutes", number(plan.minutes)},
          {"shows", plan.shows},
          {"separates", plan.separates}};
}

Json held_out_json(const Interval& one, const char* unit) {
  return {{"value", number(one.value)},
          {"low", number(one.low)},
          {"high", number(one.high)},
          {"unit", unit}};
}

/// Where to go: a table with the columns of a measurement, and where the balls stand.
Json measurement_json(const MachinePlan& plan, const Machine& machine) {
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
  for (const MachinePlan& plan : d.plans) {
    if (plan.code != d.next_plan) continue;
    Json json = plan_json(plan);
    json["measurement"] = measurement_json(plan, machine);
    return json;
  }
  return {{"plan", ""}, {"why_not", "no plan shows or separates anything more"}};
}

Json check_json(const QualityCheck& check) {
  return {{"effect", check.effect}, {"found", check.found}, {"text", check.text}};
}

Json options_json(const MachineDiagnosis& d) {
  return {{"false_alarm", number(d.false_alarm)},
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
  return {{"schema", "trueaxis.machine_diagnosis/1"},
          {"version", TRUEAXIS_VERSION},
          {"machine", machine.name},
          {"inputs", inputs_json(d.baseline)},
          {"options", options_json(d)},
          {"verdict", to_string(d.verdict)},
          {"consequences", consequences_json(d)},
          {"baseline", baseline_json(d.baseline)},
          {"extended", {{"parameters", parameters_json(d.extended)}}},
          {"findings", list_of(d.findings, finding_json)},
          {"unexplained", list_of(d.unexplained, unexplained_json)},
          {"not_observable", list_of(d.not_observable, not_observable_json)},
          {"remarks", d.remarks},
          {"checks", list_of(d.checks, check_json)},
          {"noise",
           {{"sigma", with_unit(d.noise_mm, "mm")}, {"source", "residuals of the extended model"}}},
          {"gain",
           {{"rms_before", with_unit(d.rms_before_mm, "mm")},
            {"rms_after", with_unit(d.rms_after_mm, "mm")},
            {"held_out_rms_before", held_out_json(d.held_out_before_mm, "mm")},
            {"held_out_rms_after", held_out_json(d.held_out_after_mm, "mm")},
            {"held_out_ratio", held_out_json(d.held_out_ratio, "1")},
            {"blocks", std::to_string(d.blocks) + " blocks of rotary positions"}}},
          {"next_measurement", next_json(d, machine)},
          {"plans", list_of(d.plans, plan_json)},
          {"false_alarm", number(d.false_alarm)},
          {"hypotheses", d.hypotheses},
          {"effective_hypotheses", number(d.effective_hypotheses)},
          {"threshold", number(d.threshold)}};
}

}  // namespace trueaxis
