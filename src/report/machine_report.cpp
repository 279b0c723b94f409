// SPDX-License-Identifier: Apache-2.0
#include "report/machine_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "job/files/job_words.hpp"
#include "job/machine/files/machine_job_results.hpp"
#include "machine/error_name.hpp"
#include "report/page.hpp"
#include "report/thinning.hpp"

namespace trueaxis {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double um(double length_mm) { return rounded(length_mm / mm_per_um, 3); }

double norm(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

const char* outcome(const MachineJobVerdict& verdict) {
  switch (verdict.decision) {
    case Decision::go:
      return "go";
    case Decision::go_with_reservations:
      return "reserved";
    case Decision::not_proven:
      return "not-proven";
    case Decision::no_go:
      return "no-go";
    default:
      return "done";
  }
}

Json verdict_data(const MachineJobResult& result) {
  const MachineJobVerdict& v = result.verdict;
  Json data{{"outcome", outcome(v)},
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
  Json data{{"count", tips.size()}};
  const std::vector<std::size_t> drawn = drawn_tips(tips);
  data["thinned"] = drawn.size() < tips.size();
  for (const char* key : {"line", "before_um", "after_um", "u_um"}) data[key] = Json::array();
  for (const char* key : {"tip_mm", "by_before_um", "by_after_um"})
    data[key] = Json::array({Json::array(), Json::array(), Json::array()});
  for (const std::size_t i : drawn) {
    const ProgramTip& tip = tips[i];
    data["line"].push_back(tip.line);
    data["before_um"].push_back(um(norm(tip.before_mm)));
    data["after_um"].push_back(um(norm(tip.after_mm)));
    data["u_um"].push_back(um(tip.u_mm));
    for (std::size_t k = 0; k < 3; ++k) {
      data["tip_mm"][k].push_back(rounded(tip.tip_mm[k], 3));
      data["by_before_um"][k].push_back(um(tip.before_mm[k]));
      data["by_after_um"][k].push_back(um(tip.after_mm[k]));
    }
  }
  return data;
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
  Json list = Json::array();
  for (const ErrorMap& map : result.maps) {
    Json at = Json::array(), before = Json::array(), after = Json::array();
    for (const MachineAxis& axis : result.job.machine.axes)
      if (axis.name != map.across && axis.name != map.up)
        at.push_back({{"name", std::string(1, letter_of(axis.name))},
                      {"unit", is_rotary(axis.name) ? "°" : "mm"},
                      {"value", edge_of(axis.name, map.at[index_of(axis.name)])}});
    for (const double value : map.before_mm) before.push_back(um(value));
    for (const double value : map.after_mm) after.push_back(um(value));
    list.push_back({{"across", axis_data(map.across, map.across_positions)},
                    {"up", axis_data(map.up, map.up_positions)},
                    {"at", std::move(at)},
                    {"before_um", std::move(before)},
                    {"after_um", std::move(after)}});
  }
  return list;
}

Json part_data(const PartDisplacement& part) {
  Json shift = Json::array(), turn = Json::array();
  for (std::size_t k = 0; k < 3; ++k) {
    shift.push_back(um(part.shift_mm[k]));
    turn.push_back(rounded(1e6 * part.turn_rad[k], 2));
  }
  return {{"shift_um", std::move(shift)}, {"turn_urad", std::move(turn)}};
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
            {"header", Json::array()},
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
  for (const auto& [label, text] : result.job.header) data["header"].push_back({label, text});
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
