// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "job/part_form_steps.hpp"

namespace trueaxis {
namespace {

FormJudgement judged(const char* what, const char* parameter, const char* reference,
                     double tolerance_mm, const PartForm& form) {
  FormJudgement out{what, parameter, tolerance_mm, Conformity::not_judged,
                    {},   {},        {},           form.why_not};
  if (!form.why_not.empty()) return out;
  const SectionForm* section = nullptr;
  const FormValue* with = worst_value(form.with_open(), parameter, reference, &section);
  const FormValue* without = worst_value(form.without_open(), parameter, reference);
  const double k = form.probed.options.coverage_factor;
  if (!with || !without || !std::isfinite(most_of(*with, k)) ||
      !std::isfinite(most_of(*without, k))) {
    out.why = std::string("the readings give no ") + parameter;
    if (!form.probed.radius_known)
      out.why += ": a gauge without nominal_radius does not show the radius";
    return out;
  }
  const bool ordered = most_of(*with, k) >= most_of(*without, k);
  out.high = ordered ? *with : *without;
  out.low = ordered ? *without : *with;
  if (section) out.z_mm = section->z_mm;
  out.conformity = most_of(out.high, k) <= tolerance_mm ? Conformity::met
                   : std::min(least_of(*with, k), least_of(*without, k)) > tolerance_mm
                       ? Conformity::not_met
                       : Conformity::not_proven;
  return out;
}

}  // namespace

void judge(const FormTask& task, PartForm& form) {
  if (task.roundness_tolerance_mm)
    form.judgements.push_back(
        judged("roundness", "RONt", "MZCI", *task.roundness_tolerance_mm, form));
  if (task.cylindricity_tolerance_mm)
    form.judgements.push_back(
        judged("cylindricity", "CYLt", "MZCY", *task.cylindricity_tolerance_mm, form));
  if (!task.runout_tolerance_mm) return;
  const bool face = worst_value(form.probed, "axial_runout_circular", "") != nullptr;
  form.judgements.push_back(judged(face ? "axial run-out" : "circular run-out",
                                   face ? "axial_runout_circular" : "runout_circular", "",
                                   *task.runout_tolerance_mm, form));
}

Reasons form_reservations(std::span<const PartForm> forms) {
  constexpr ReasonCode codes[] = {ReasonCode::count_, ReasonCode::form_not_met,
                                  ReasonCode::form_not_proven, ReasonCode::form_not_judged};
  Reasons list;
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (const FormJudgement& one : forms[i].judgements)
      if (one.conformity != Conformity::met)
        list.push_back(
            {codes[static_cast<std::size_t>(one.conformity)], {i}, {}, {{"form", one.what}}});
  return list;
}

bool PartForm::met() const {
  return std::ranges::all_of(
      judgements, [](const FormJudgement& one) { return one.conformity == Conformity::met; });
}

const FormValue* worst_value(const FormResult& form, const std::string& name,
                             const std::string& reference, const SectionForm** section) {
  const FormValue* worst = nullptr;
  const auto look = [&](const std::vector<FormValue>& values, const SectionForm* of) {
    for (const FormValue& one : values) {
      if (one.name != name || (!reference.empty() && one.reference != reference)) continue;
      if (worst && !(size_of(one) > size_of(*worst))) continue;
      worst = &one;
      if (section) *section = of;
    }
  };
  for (const SectionForm& one : form.sections) look(one.values, &one);
  for (const FormGroup& group : form.groups) look(group.values, nullptr);
  return worst;
}

const char* to_string(Conformity conformity) {
  static constexpr const char* words[] = {"met", "not_met", "not_proven", "not_judged"};
  return words[static_cast<std::size_t>(conformity)];
}

}  // namespace trueaxis
