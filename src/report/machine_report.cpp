// SPDX-License-Identifier: Apache-2.0
#include "report/machine_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "job/files/job_words.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "machine/error_name.hpp"
#include "report/chart_readings.hpp"
#include "report/page.hpp"
#include "report/page_data.hpp"

namespace trueaxis {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double um(double length_mm) { return rounded(length_mm / mm_per_um, 3); }

double norm(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

Json verdict_data(const MachineJobResult& result) {
  const MachineJobVerdict& v = result.verdict;
  Json data{{"outcome", outcome_of(v.decision, v.decision == Decision::go)},
            {"line", machine_verdict_line(v)},
            {"next", machine_next_words(v)},
            {"reservations", sentences_of(v.reservations, {})},
            {"remarks", sentences_of(result.remarks, {})},
            {"tolerance_um", result.job.tolerance_mm ? um(*result.job.tolerance_mm) : nothing}};
  if (result.tips.empty()) return data;
  data["path_before_um"] = um(v.path_before_mm());
  data["before_um"] = um(v.before_mm);
  data["before_line"] = v.before_line;
  data["after_um"] = um(v.after_mm);
  data["between_before_um"] = um(v.between_before_mm);
  data["between_um"] = um(v.between_mm);
  data["not_corrected_um"] = um(v.not_corrected_mm);
  data["U_um"] = um(v.U_mm);
  data["at_most_um"] = um(v.upper_mm);
  return data;
}

/// Of long programs the tip that is furthest off in every run of as many.
std::vector<std::size_t> drawn_tips(const std::vector<ProgramTip>& tips) {
  std::vector<std::size_t> drawn;
  const std::size_t run = (tips.size() + max_drawn_tips - 1) / max_drawn_tips;
  for (std::size_t first = 0; first < tips.size(); first += run) {
    std::size_t most = first;
    for (std::size_t i = first; i < std::min(tips.size(), first + run); ++i)
      if (norm(tips[i].before_mm) > norm(tips[most].before_mm)) most = i;
    drawn.push_back(most);
  }
  return drawn;
}

Json tips_data(const std::vector<ProgramTip>& tips) {
  const std::vector<std::size_t> drawn = drawn_tips(tips);
  const auto column = [&](const auto& of) {
    return list_of(drawn, [&](std::size_t i) { return of(tips[i]); });
  };
  const auto by_axis = [&](const auto& of) {
    return list_of_first(3, [&](std::size_t k) {
      return column([&](const ProgramTip& tip) { return of(tip, k); });
    });
  };
  using Tip = const ProgramTip&;
  return {{"count", tips.size()},
          {"thinned", drawn.size() < tips.size()},
          {"line", column([](Tip tip) { return tip.line; })},
          {"before_um", column([](Tip tip) { return um(norm(tip.before_mm)); })},
          {"after_um", column([](Tip tip) { return um(norm(tip.after_mm)); })},
          {"u_um", column([](Tip tip) { return um(tip.u_mm); })},
          {"tip_mm", by_axis([](Tip tip, std::size_t k) { return rounded(tip.tip_mm[k], 3); })},
          {"by_before_um", by_axis([](Tip tip, std::size_t k) { return um(tip.before_mm[k]); })},
          {"by_after_um", by_axis([](Tip tip, std::size_t k) { return um(tip.after_mm[k]); })}};
}

double edge_of(AxisName axis, double position) {
  return rounded(is_rotary(axis) ? position / rad_per_deg : position, 3);
}

Json axis_data(AxisName axis, const std::vector<double>& middles) {
  const double half = 0.5 * (middles[1] - middles[0]);
  return {{"name", std::string(1, letter_of(axis))},
          {"unit", is_rotary(axis) ? "°" : "mm"},
          {"count", middles.size()},
          {"low", edge_of(axis, middles.front() - half)},
          {"high", edge_of(axis, middles.back() + half)}};
}

Json maps_data(const MachineJobResult& result) {
  return list_of(result.maps, [&](const ErrorMap& map) -> Json {
    Json at = Json::array();
    for (const MachineAxis& axis : result.job.machine.axes)
      if (axis.name != map.across && axis.name != map.up)
        at.push_back({{"name", std::string(1, letter_of(axis.name))},
                      {"unit", is_rotary(axis.name) ? "°" : "mm"},
                      {"value", edge_of(axis.name, map.at[index_of(axis.name)])}});
    return {{"across", axis_data(map.across, map.across_positions)},
            {"up", axis_data(map.up, map.up_positions)},
            {"at", std::move(at)},
            {"before_um", list_of(map.before_mm, um)},
            {"after_um", list_of(map.after_mm, um)}};
  });
}

Json part_data(const PartDisplacement& part) {
  const auto urad = [](double turn_rad) { return rounded(1e6 * turn_rad, 2); };
  return {{"shift_um", list_of(part.shift_mm, um)}, {"turn_urad", list_of(part.turn_rad, urad)}};
}

/// What every error and effect is called that a text may name.
Json titles_data(const MachineDiagnosis& diagnosis) {
  Json titles = Json::object();
  for (const bool component : {false, true})
    for (std::size_t body = 0; body < (component ? axis_count : workpiece_body + 1); ++body)
      for (std::size_t direction = 0; direction < axis_count; ++direction) {
        const ErrorName name{component, direction, body};
        titles[to_string(name)] = words_of(name);
      }
  for (const MachineEffect& effect : diagnosis.effects) titles[effect.id] = effect.title;
  return titles;
}

std::string title_of(const MachineJob& job) { return job.name.empty() ? job.path : job.name; }

}  // namespace

Json machine_report_data(const MachineJobResult& result) {
  const Json run = machine_job_object(result);
  Json data{{"schema", "trueaxis.machine_report/1"},
            {"version", TRUEAXIS_VERSION},
            {"title", title_of(result.job)},
            {"file", result.job.path},
            {"machine", result.job.machine.name},
            {"chain", result.job.machine.chain},
            {"header", result.job.header},
            {"verdict", verdict_data(result)},
            {"inputs", run.at("inputs")},
            {"ranges", run.at("ranges")},
            {"maps", maps_data(result)},
            {"titles", titles_data(result.diagnosis)},
            {"words", {{"measurements", Json::object()}}},
            {"diagnosis", machine_diagnosis_object(result.diagnosis, result.job.machine)}};
  data["diagnosis"].erase("effects");
  for (const MachinePlan& plan : result.diagnosis.plans)
    data["words"]["measurements"][plan.code] = plan.what;
  if (!result.tips.empty()) data["tips"] = tips_data(result.tips);
  if (result.part) data["part"] = part_data(*result.part);
  if (result.compensation) {
    data["compensation"] = Json::parse(job_compensation_json(result));
    data["program"] = result.job.program->file;
  }
  return data;
}

std::string render_machine_diagnosis_report(const MachineJobResult& result, const Json& program) {
  const std::string line = machine_diagnosis_line(result.diagnosis, "→");
  Json data = machine_report_data(result);
  data["of"] = "diagnosis";
  data["verdict"]["outcome"] = to_string(result.diagnosis.verdict);
  data["verdict"]["line"] = line;
  data["verdict"]["next"] = next_plan_text(result.diagnosis, PlanBy::deed);
  if (!program.is_null()) data["harm"] = program;
  return page_of("TrueAxis diagnosis: " + title_of(result.job), line, data, machine_script());
}

std::string render_machine_report(const MachineJobResult& result) {
  Json tables = machine_job_object(result);  // without the reasons as data: they are in words
  for (const char* key : {"reasons", "reserved", "next_steps"}) tables["verdict"].erase(key);
  return page_of("TrueAxis report: " + title_of(result.job), machine_verdict_line(result.verdict),
                 machine_report_data(result), machine_script(), &tables);
}

}  // namespace trueaxis
