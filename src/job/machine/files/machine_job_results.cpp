// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "base/text.hpp"
#include "calibrate/files/machine_diagnosis_files.hpp"
#include "compensate/files/compensation_files.hpp"
#include "format/text_layout.hpp"
#include "format/toml_header.hpp"
#include "job/files/job_words.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

Json verdict_json(const MachineJobResult& result) {
  const MachineJobVerdict& v = result.verdict;
  Json json{{"go", v.go()},
            {"decision", to_string(v.decision)},
            {"line", machine_verdict_line(v)},
            {"reasons", reasons_array(v.reasons, Spoken{})},
            {"reservations", sentences_of(v.reservations, {})},
            {"reserved", reasons_array(v.reservations, Spoken{})},
            {"next", machine_next_words(v)},
            {"next_steps", reasons_array(v.next, Spoken{})},
            {"remarks", sentences_of(result.remarks, {})}};
  if (result.tips.empty()) return json;
  json["tip_before"] = at_line(mm_json(v.before_mm), v.before_line);
  json["tip_after"] = at_line(mm_json(v.after_mm), v.after_line);
  json["between_blocks_before"] = at_line(mm_json(v.between_before_mm), v.between_before_line);
  json["between_blocks_after"] = with_unit(v.between_mm, "mm");
  json["not_corrected"] = with_unit(v.not_corrected_mm, "mm");
  json["U_without_place_of_part"] = with_unit(v.U_mm, "mm");
  json["U_without_place_of_part"]["coverage_factor"] = 2;
  json["tip_at_least"] = with_unit(v.lower_mm, "mm");
  json["tip_at_most"] = with_unit(v.upper_mm, "mm");
  json["risk"] = nonconformity_risk;
  if (result.job.tolerance_mm) json["tolerance"] = with_unit(*result.job.tolerance_mm, "mm");
  return json;
}

Json vector_json(const Vector3& v, double unit, const char* name) {
  return {{"value", {number(v[0] / unit), number(v[1] / unit), number(v[2] / unit)}},
          {"unit", name}};
}

Json ranges_json(const MachineJobResult& result) {
  Json json = Json::object();
  for (const AxisRange& range : result.ranges) {
    const bool rotary = is_rotary(range.axis);
    const double unit = rotary ? rad_per_deg : 1.0;
    Json one{{"measured", {range.measured_low / unit, range.measured_high / unit}}};
    if (range.program) one["program"] = {(*range.program)[0] / unit, (*range.program)[1] / unit};
    one["unit"] = rotary ? "deg" : "mm";
    json[std::string(1, letter_of(range.axis))] = std::move(one);
  }
  return json;
}

}  // namespace

std::string machine_verdict_line(const MachineJobVerdict& verdict) {
  std::string line = decision_line(verdict.decision, verdict.reasons);
  for (const Reason& one : verdict.reservations)
    if (verdict.go()) line += "; " + words_of(one);
  return line;
}

std::string machine_next_words(const MachineJobVerdict& verdict) {
  std::string text = words_of(verdict.next, "; ");
  if (text.empty()) return text;
  text[0] = upper_case(text[0]);
  return text.ends_with('.') ? text : text + '.';
}

std::string new_program_name(const MachineJob& job) {
  if (!job.program) return "";
  const std::filesystem::path path(job.program->file);
  return path.stem().string() + "_compensated" + path.extension().string();
}

Json machine_job_object(const MachineJobResult& result) {
  const auto input = [](const JobInput& one) -> Json {
    return {{"what", one.what}, {"file", one.file}, {"hash", one.hash}};
  };
  Json json{{"schema", "trueaxis.machine_run/1"},
            {"version", TRUEAXIS_VERSION},
            {"job", result.job.name},
            {"machine", result.job.machine.name},
            {"inputs", list_of(result.job.inputs, input)},
            {"verdict", verdict_json(result)}};
  if (!result.job.header.empty()) json["header"] = header_object(result.job.header);
  if (result.part)
    json["part_as_a_whole"] = {{"about", vector_json(result.part->about_mm, 1.0, "mm")},
                               {"shift", vector_json(result.part->shift_mm, 1.0, "mm")},
                               {"turn", vector_json(result.part->turn_rad, rad_per_deg, "deg")}};
  json["ranges"] = ranges_json(result);
  json["files"] = {{"errors", result.implausible.empty() ? Json("errors.toml") : Json(nullptr)},
                   {"diagnosis", "diagnosis.json"}};
  if (result.compensation) json["files"]["compensation"] = "compensation.json";
  if (result.job.program)
    json["files"]["program"] =
        result.verdict.go() ? Json(new_program_name(result.job)) : Json(nullptr);
  return json;
}

std::string machine_job_json(const MachineJobResult& result) {
  return json_text(machine_job_object(result));
}

std::string job_compensation_json(const MachineJobResult& result) {
  expects(result.compensation.has_value(), "a job with a program");
  std::vector<CompensationInput> inputs;
  for (const JobInput& input : result.job.inputs) inputs.push_back({input.file, input.hash});
  return compensation_json(*result.compensation, result.job.program->options, inputs,
                           result.job.remarks_of_known);
}

std::string machine_job_text(const MachineJobResult& result) {
  std::string text = machine_verdict_line(result.verdict) + "\n";
  text += layout::wrapped("next    ", machine_next_words(result.verdict)) + "\n";
  text += machine_diagnosis_text(result.diagnosis);
  if (result.compensation && result.compensation->unreachable.empty())
    text += compensation_text(*result.compensation, result.job.program->options);
  for (const Reason& remark : result.remarks) text += layout::wrapped("", words_of(remark)) + '\n';
  return text;
}

}  // namespace trueaxis
