// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <set>

#include "diagnose/files/diagnosis_json.hpp"
#include "form/files/form_files.hpp"
#include "job/files/job_results.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::array<const char*, 2> of_section[] = {
    {"RONt", "MZCI"}, {"RONq", "LSCI"}, {"eccentricity", "LSCI"}};

Json value_object(const FormValue& one) {
  const Estimate edge = at_edge(one.estimate);
  Json json{{"value", number(edge.value)},
            {"u", number(edge.u)},
            {"unit", edge.unit},
            {"bias_by_noise", number(edge_factor(one.estimate.unit) * one.bias_mm)}};
  if (!one.reference.empty()) json["reference"] = one.reference;
  if (edge.interval) {
    json["why"] = edge.why_not;
    json["at_most"] = number(edge.interval->back());
  }
  if (one.unresolved) json["unresolved"] = true;
  return json;
}

/// Values of the whole and the worst of the sections, by name: about the minimum zone where a value
/// is about something.
Json values_object(const FormResult& form) {
  Json json = Json::object();
  const FormValue* round = worst_value(form, "RONt", "MZCI");
  if (round) json["RONt"] = value_object(*round);
  for (const FormGroup& group : form.groups)
    for (const FormValue& one : group.values)
      if (one.reference.empty() || one.reference.starts_with("MZ") || one.name == "CYLtt" ||
          one.name == "CYLrr" || one.name == "CYLat")
        json[one.name] = value_object(one);
  return json;
}

const FormValue* of(const SectionForm& section, const std::array<const char*, 2>& which) {
  for (const FormValue& one : section.values)
    if (one.name == which[0] && (one.reference == which[1] || one.reference.empty())) return &one;
  return nullptr;
}

Json section_object(const SectionForm& section) {
  Json json;
  if (section.z_mm) json["z"] = with_unit(*section.z_mm, "mm");
  json["readings"] = section.readings;
  json["lobes"] = section.lobes;
  for (const auto& which : of_section)
    if (const FormValue* one = of(section, which)) json[which[0]] = value_object(*one);
  return json;
}

Json case_object(const FormResult& form) {
  return {{"values", values_object(form)}, {"sections", list_of(form.sections, section_object)}};
}

Json judgement_object(const FormJudgement& one) {
  Json json{{"what", one.what},
            {"parameter", one.parameter},
            {"tolerance", with_unit(one.tolerance_mm, "mm")},
            {"conformity", to_string(one.conformity)}};
  if (one.conformity == Conformity::not_judged) {
    json["why"] = one.why;
    return json;
  }
  json["at_least"] = value_object(one.low);
  json["at_most"] = value_object(one.high);
  if (one.z_mm) json["z"] = with_unit(*one.z_mm, "mm");
  return json;
}

}  // namespace

Json part_form_object(const PartForm& form) {
  Json json;
  if (!form.why_not.empty()) {
    json["why"] = form.why_not;
  } else {
    const FormOptions& options = form.probed.options;
    if (!form.probed.sections.empty()) {
      json["filter"] = {{"kind", to_string(options.filter)}};
      if (options.filter != ProfileFilter::none)
        json["filter"]["upr"] = {options.low_upr, options.high_upr};
      json["carried_upr"] = form.carried_upr;
    }
    json["coverage_factor"] = options.coverage_factor;
    json["datum"] = form.probed.datum_source.empty() ? spindle_axis : form.probed.datum_source;
    json["swallowed"] = swallowed_json(form.probed);
    if (form.probed.surface) json["surface"] = surface_json(*form.probed.surface);
    json["left_out"] = form.left_out;
    if (form.local_mm > 0.0) json["local_forms"] = with_unit(form.local_mm, "mm");
    json["as_probed"] = case_object(form.probed);
    json["motion"] = form.motion;
    json["open"] = form.open;
    if (form.less_motion) json["less_motion"] = case_object(*form.less_motion);
    if (form.less_open) json["less_open"] = case_object(*form.less_open);
    std::set<std::string> said;
    json["notes"] = Json::array();
    for (const std::string& note : form.probed.notes)
      if (said.insert(note).second) json["notes"].push_back(note);
  }
  json["judgements"] = list_of(form.judgements, judgement_object);
  return json;
}

std::string diagnosis_with_form(const Diagnosis& diagnosis, const PartForm& form) {
  Json json = diagnosis_object(diagnosis);
  if (diagnosis.baseline.status == FitStatus::converged) json["form"] = part_form_object(form);
  return json_text(json);
}

}  // namespace trueaxis
