// SPDX-License-Identifier: Apache-2.0
#include "job/files/job_results.hpp"

#include <fmt/format.h>

#include "correct/files/table_files.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "fit/files/fit_files.hpp"
#include "format/file.hpp"
#include "format/toml_header.hpp"
#include "job/agreement.hpp"
#include "job/beyond_probed.hpp"
#include "job/cut_files.hpp"
#include "job/files/feedback_files.hpp"
#include "job/files/job_words.hpp"
#include "recording/import.hpp"
#include "resimulate/files/comparison.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// What each file that a go would write adds, as its control reads it.
Json cut_files_array(const Verdict& v) {
  return list_of(v.files, [](const CutFile& file) -> Json {
    return {{"name", file.name},
            {"adds", mm_json(file.adds_mm)},
            {"by_actuator", mm_json(file.actuator_mm)},
            {"by_file", mm_json(file.file_mm)}};
  });
}

Json verdict_object(const JobResult& result) {
  const Verdict& v = result.verdict;
  Json json{
      {"go", v.go()},
      {"decision", to_string(v.decision)},
      {"line", verdict_line(result)},
      {"reasons", reasons_array(v.reasons, result)},
      {"reservations", sentences_of(v.reservations, result)},
      {"reserved", reasons_array(v.reservations, result)},
      {"file", v.file},
      {"files", cut_files_array(v)},
      {"coaxiality_before", with_unit(v.coaxiality_before_mm, "mm")},
      {"coaxiality_after", to_json(Estimate{v.coaxiality_after_mm, v.u_coaxiality_mm, "mm", ""})},
      {"coaxiality_at_least", with_unit(v.lower_mm, "mm")},
      {"coaxiality_at_most", with_unit(v.upper_mm, "mm")},
      {"risk", nonconformity_risk},
      {"what_would_prove", words_of(v.what_would_prove(), "; ", result)},
      {"moved", words_of(v.moved, "; ", result)},
      {"coverage_factor", v.coverage_factor}};
  if (!result.correction)  // nothing is cut: no number, not a 0
    for (const char* of_cut :
         {"coaxiality_before", "coaxiality_after", "coaxiality_at_least", "coaxiality_at_most"})
      for (auto& [key, member] : json[of_cut].items())
        if (member.is_number()) member = nullptr;
  return json;
}

Json remainders_array(const std::vector<Remainder>& list) {
  return list_of(list, [](const Remainder& r) -> Json {
    return {{"reference", r.name},
            {"offset_start", mm_json(r.offset_start_mm)},
            {"offset_end", mm_json(r.offset_end_mm)},
            {"tilt", deg_json(r.tilt_rad)},
            {"coaxiality", to_json(Estimate{r.coaxiality_mm, r.u_coaxiality_mm, "mm", ""})},
            {"coaxiality_at_most", mm_json(r.limit_mm)}};
  });
}

/// A face has a direction alone.
Json target_axis_object(const TargetAxis& target, const TargetSurface& surface) {
  Json json{{"slope_x", with_unit(target.axis.axis.slope_x, "1")},
            {"slope_y", with_unit(target.axis.axis.slope_y, "1")},
            {"u_slope", with_unit(target.axis.u_slope(), "1")},
            {"remainders", remainders_array(target.remainders)}};
  if (surface.kind == TargetKind::face) return json;
  const auto [x, y] = target.axis.axis.at(surface.z_start_mm);
  json["x_at_start"] = with_unit(x, "mm");
  json["y_at_start"] = with_unit(y, "mm");
  json["u_at_start"] = with_unit(target.axis.u_at(surface.z_start_mm), "mm");
  json["u_at_end"] = with_unit(target.axis.u_at(surface.z_end_mm), "mm");
  return json;
}

/// The datum system of the target, and what its axis leaves at the references.
Json datum_object(const JobResult& result) {
  return {{"name", result.datum->name},
          {"how", datum_words(result)},
          {"remainders", remainders_array(result.datum->references)}};
}

/// The references compared with each other: what is apart beyond its U, and why nothing may be cut.
Json agreement_object(const JobResult& result) {
  const double k = result.job.references.front().fit.coverage_factor;
  const auto pair_json = [&](const Disagreement& d) {
    Json pair{{"first", result.job.references[d.first].name},
              {"second", result.job.references[d.second].name},
              {"tilt", to_json(Estimate{d.tilt_rad, d.U_tilt_rad / k, "rad", ""})},
              {"p_value", d.p_value}};
    if (d.U_offset_mm > 0.0)
      pair["offset"] = to_json(Estimate{d.offset_mm, d.U_offset_mm / k, "mm", ""});
    return pair;
  };
  return {{"disagreements", list_of(result.agreement.disagreements, pair_json)},
          {"reason", result.agreement.reason ? words_of(*result.agreement.reason, result) : ""},
          {"odds", number(result.agreement.odds)}};
}

Json resimulation_object(const Resimulation& again) {
  if (!again.why_not.empty()) return {{"why", again.why_not}};
  return comparison_object(again.comparison);
}

Json diagnosis_of(const JobResult& result, std::size_t i) {
  if (!result.diagnoses[i]) return {{"verdict", nullptr}, {"why", "its fit did not converge"}};
  Json summary = diagnosis_summary(*result.diagnoses[i]);
  summary["file"] = diagnosis_file(result.job, i);
  summary["readings"] = readings_file(result.job, i);
  if (i < result.resimulations.size() && result.resimulations[i])
    summary["simulated_again"] = resimulation_object(*result.resimulations[i]);
  summary["axis_of_the_correction"] = result.diagnoses[i]->verdict == DiagnosisVerdict::ideal ||
                                              result.job.axis_of_cut == AxisOfCut::ideal
                                          ? "ideal surface"
                                      : result.job.axis_of_cut == AxisOfCut::named
                                          ? "named model"
                                          : "extended model";
  return summary;
}

Json inclusions_array(const std::vector<Inclusion>& inclusions) {
  return list_of(inclusions, [](const Inclusion& i) -> Json {
    return {{"effect", i.effect},
            {"reference", i.reference},
            {"included", i.included},
            {"refused", i.refused},
            {"code", i.why ? Json(to_string(i.why->code)) : Json(nullptr)},
            {"why", i.why ? words_of(*i.why) : ""}};
  });
}

/// Number and name of a reference, as far as any file system takes it.
std::string file_stem(const Job& job, std::size_t reference) {
  std::string name;
  for (const char c : job.references[reference].name) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += kept ? c : '_';
  }
  return std::to_string(reference + 1) + "_" + name.substr(0, 40);
}

std::string diagnosis_text_of(const JobResult& result, std::size_t i) {
  if (!result.diagnoses[i]) return "";
  const Diagnosis& diagnosis = *result.diagnoses[i];
  const bool again = diagnosis.verdict != DiagnosisVerdict::ideal && result.resimulations[i];
  return findings_text(diagnosis) + (again ? resimulation_line(*result.resimulations[i]) : "");
}

}  // namespace

Json correction_object(const Correction& correction) {
  const auto harmonic = [](const CorrectionHarmonic& h) -> Json {
    return {{"order", h.order},
            {"amplitude_start", mm_json(h.amplitude_start_mm)},
            {"phase_start", deg_json(h.phase_start_rad)},
            {"amplitude_end", mm_json(h.amplitude_end_mm)},
            {"phase_end", deg_json(h.phase_end_rad)},
            {"actuator_gain", h.gain},
            {"actuator_lag", deg_json(h.lag_rad)}};
  };
  const ActuatorMargin& m = correction.margin;
  const TargetSurface& target = correction.target;
  const bool face = target.kind == TargetKind::face;
  return {{"rows", correction.rows.wanted_mm.size()},
          {"contact",
           {{"start", with_unit(face ? target.radius_start_mm : target.z_start_mm, "mm")},
            {"end", with_unit(face ? target.radius_end_mm : target.z_end_mm, "mm")}}},
          {"nose_centre",
           {{"start", with_unit(correction.position_start_mm, "mm")},
            {"end", with_unit(correction.position_end_mm, "mm")}}},
          {"between_rows",
           {{"interpolation", to_string(correction.tool.interpolation)},
            {"largest", with_unit(correction.between_rows.largest_mm, "mm")},
            {"once", with_unit(correction.between_rows.once_mm, "mm")},
            {"held",
             {{"largest", with_unit(correction.held_rows.largest_mm, "mm")},
              {"once", with_unit(correction.held_rows.once_mm, "mm")}}}}},
          {"harmonics", list_of(correction.harmonics, harmonic)},
          {"margin",
           {{"follows", m.follows},
            {"breaks", words_of(m.breaks, "; ")},
            {"remedy", words_of(m.remedies, ", or ")},
            {"broken", reasons_array(m.breaks, Spoken{})},
            {"remedies", reasons_array(m.remedies, Spoken{})},
            {"max_speed", with_unit(m.max_speed_rpm, "rpm")},
            {"stroke_used", with_unit(m.stroke_used_mm, "mm")},
            {"stroke_available", with_unit(m.stroke_available_mm, "mm")},
            {"slew_used", with_unit(m.slew_used_mm_per_s, "mm/s")},
            {"slew_available", with_unit(m.slew_available_mm_per_s, "mm/s")},
            {"highest_frequency", with_unit(m.highest_frequency_hz, "Hz")},
            {"bandwidth", with_unit(m.bandwidth_hz, "Hz")},
            {"set_points_per_revolution", number(m.set_points_per_revolution)},
            {"following_uncompensated", with_unit(m.following_uncompensated_mm, "mm")},
            {"following", with_unit(m.following_mm, "mm")},
            {"following_once", with_unit(m.following_once_mm, "mm")},
            {"following_limit", with_unit(m.following_limit_mm, "mm")}}}};
}

std::string diagnosis_file(const Job& job, std::size_t reference) {
  return "diagnosis_" + file_stem(job, reference) + ".json";
}

std::string readings_file(const Job& job, std::size_t reference) {
  return "readings_" + file_stem(job, reference) + ".csv";
}

Json job_object(const JobResult& result) {
  Json json;
  json["schema"] = "trueaxis.run/2";
  json["version"] = TRUEAXIS_VERSION;
  json["job"] = result.job.name;
  if (!result.job.header.empty()) json["header"] = header_object(result.job.header);
  json["verdict"] = verdict_object(result);
  json["references"] = list_of_first(result.fits.size(), [&](std::size_t i) {
    Json reference{{"name", result.job.references[i].name},
                   {"weight", result.job.references[i].weight},
                   {"fit", fit_object(result.fits[i])}};
    if (result.correction) reference["u_beyond_probed"] = number(u_beyond_probed(result, i));
    if (!result.job.target) reference["axis"] = seat_axis_object(result, i);
    if (i < result.diagnoses.size()) reference["diagnosis"] = diagnosis_of(result, i);
    if (i < result.forms.size()) reference["form"] = part_form_object(result.forms[i]);
    if (i < result.datum_axes.size() && !result.datum_axes[i].empty()) {
      const auto& association = result.job.references[i].association;
      reference["association"] =
          association ? name_of(*association) : "least squares along the probe line";
      reference["other_associations"] = datum_axes_array(result.datum_axes[i], fit_used(result, i));
    }
    return reference;
  });
  json["forms_met"] = forms_met(result);
  if (result.fits.size() > 1 || result.agreement.reason)
    json["agreement"] = agreement_object(result);
  if (result.fits.size() > 1 && !result.job.target) json["seats_apart"] = seats_apart_array(result);
  if (result.target_axis)
    json["target_axis"] = target_axis_object(*result.target_axis, *result.job.target);
  if (result.datum) json["datum"] = datum_object(result);
  if (result.correction) {
    json["correction"] = correction_object(*result.correction);
    json["correction"]["between_rows"]["coarse"] = coarse_rows_words(result);
  }
  if (!result.inclusions.empty()) json["included"] = inclusions_array(result.inclusions);
  if (result.feedback) json["feedback"] = feedback_object(result);
  return json;
}

std::string job_json(const JobResult& result, const std::vector<ResultFile>& beside) {
  Json json = job_object(result);
  json["files"] = list_of(beside, [](const ResultFile& file) -> Json {
    return {{"name", file.name}, {"hash", content_hash(file.text)}};
  });
  return json_text(json);
}

namespace {

/// The schema of the file for a control, as its first line says it.
std::string control_schema(const ControlTable& output) {
  constexpr const char* names[] = {"control_grid", "halstreamer", "servo_nc", "sinumerik_cec",
                                   "beckhoff_crosscomp"};
  return std::string("trueaxis.") + names[static_cast<std::size_t>(output.format)];
}

}  // namespace

std::vector<ResultName> job_file_names(const Job& job) {
  std::vector<ResultName> names{{"result.json", "trueaxis.run"}};
  for (std::size_t i = 0; i < job.references.size(); ++i) {
    names.push_back({diagnosis_file(job, i), "trueaxis.diagnosis"});
    names.push_back({readings_file(job, i), "trueaxis.residuals"});
  }
  for (const ControlTable& output : job.outputs)
    names.push_back({output.file, control_schema(output)});
  names.push_back({"table.csv", "trueaxis.correction"});
  return names;
}

namespace {

/// The files next to result.json.
std::vector<ResultFile> files_beside(const JobResult& result) {
  std::vector<ResultFile> files;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    files.push_back({diagnosis_file(result.job, i), diagnosis_json(*result.diagnoses[i])});
    files.push_back(
        {readings_file(result.job, i), residuals_csv(result.streams[i], *result.diagnoses[i],
                                                     &result.resimulations[i]->readings)});
  }
  if (!has_table(result)) return files;
  for (std::size_t i = 0; i < result.job.outputs.size(); ++i) {
    const ControlTable& output = result.job.outputs[i];
    const MadeControlTable& made = result.control_files[i];
    files.push_back(
        {output.file, made.text,
         fmt::format("{}, rounded to {:.3g} µm, as its control reads it, off by at most {:.3g} µm",
                     to_string(output.format), made.rounding_mm / mm_per_um,
                     made.off.largest_mm / mm_per_um)});
  }
  files.push_back({"table.csv", correction_csv(*result.correction)});
  return files;
}

}  // namespace

bool has_table(const JobResult& result) { return result.correction && result.verdict.go(); }

std::vector<ResultFile> job_files(const JobResult& result) {
  std::vector<ResultFile> files = files_beside(result);
  files.insert(files.begin(), {"result.json", job_json(result, files)});
  return files;
}

std::string inclusion_text(const Inclusion& i) {
  return (i.included ? "followed " : "not followed ") + i.effect +
         (i.reference.empty() ? "" : " of " + i.reference) +
         (i.why ? ": " + words_of(*i.why) : "") + "\n";
}

std::string job_text(const JobResult& result) {
  std::string text = verdict_line(result) + "\n\n";
  for (std::size_t i = 0; i < result.fits.size(); ++i)
    text +=
        fit_text(result.fits[i]) + diagnosis_text_of(result, i) +
        (i < result.forms.size() ? part_form_text(result.forms[i]) : "") +
        (i < result.datum_axes.size() ? datum_axes_text(result.datum_axes[i], fit_used(result, i))
                                      : "") +
        "\n";
  if (result.datum) text += "datum       " + result.datum->name + ": " + datum_words(result) + "\n";
  if (!result.job.target && result.fits.size() > 1) text += seats_apart_screen(result);
  for (const Disagreement& d : result.agreement.disagreements)
    text += "references  " + words_of(how_apart(d), result) + "\n";
  for (const Inclusion& inclusion : result.inclusions)
    text += "motion      " + inclusion_text(inclusion);
  if (result.correction)
    text +=
        correction_preview(*result.correction) + "\n" + coarse_rows_lines(result, "rows        ");
  text += feedback_screen(result);
  return text;
}

}  // namespace trueaxis
