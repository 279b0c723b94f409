// SPDX-License-Identifier: Apache-2.0

#include "diagnose/files/diagnosis_json.hpp"
#include "fit/files/fit_files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

double value(const Json& object, const char* key) { return object.at(key).at("value"); }

std::vector<Rejected> rows_from(const Json& list) {
  std::vector<Rejected> rows;
  for (const Json& entry : list) rows.push_back({entry.at("row"), entry.at("why")});
  return rows;
}

DiagnosisVerdict verdict_from(const std::string& text) {
  for (const DiagnosisVerdict verdict :
       {DiagnosisVerdict::ideal, DiagnosisVerdict::effects, DiagnosisVerdict::unexplained}) {
    if (text == to_string(verdict)) return verdict;
  }
  throw InputError("diagnosis", "no diagnosis says `" + text + "`");
}

Finding finding_from(const Json& json, std::span<const Effect> own_effects) {
  Finding finding;
  finding.term = effect_term_from(json.at("effect"), json.at("term"), own_effects);
  for (const Json& rival : json.at("rivals")) {
    finding.rivals.push_back({rival.at("effect"), number_from(rival.at("distance")),
                              number_from(rival.at("likelihood_ratio")),
                              number_from(rival.at("probability")), rival.at("structural")});
  }
  for (const auto& [name, estimate] : json.at("parameters").items())
    finding.parameters.push_back({name, estimate_from(estimate)});
  finding.p_value = number_from(json.at("p_value"));
  finding.probability = number_from(json.at("probability"));
  finding.axis_shift = estimate_from(json.at("axis_bias").at("axis_shift"));
  finding.cosmetic = json.at("axis_bias").at("cosmetic");
  return finding;
}

Unexplained unexplained_from(const Json& json) {
  return {pattern_term_from(json.at("term")), estimate_from(json.at("amplitude")),
          number_from(json.at("p_value"))};
}

Diagnosis diagnosis_from(const Json& json, std::span<const Effect> own_effects) {
  if (json.at("schema") != diagnosis_schema)
    throw InputError("diagnosis", std::string("is no ") + diagnosis_schema +
                                      ": write one with 'trueaxis diagnose --json'");
  Diagnosis d;
  d.verdict = verdict_from(json.at("verdict"));
  d.baseline = fit_from_object(json.at("baseline"));
  d.named = fit_from_object(json.at("named"));
  d.extended = fit_from_object(json.at("extended"));
  d.z_mid_mm = value(json.at("u_frame"), "z_mid");
  d.z_half_mm = value(json.at("u_frame"), "z_half");
  for (const Json& finding : json.at("findings"))
    d.findings.push_back(finding_from(finding, own_effects));
  for (const Json& pattern : json.at("unexplained"))
    d.unexplained.push_back(unexplained_from(pattern));
  d.next.plan = json.at("next_measurement").at("plan");
  d.next.what = json.at("next_measurement").at("what");
  d.noise.sigma_mm = value(json.at("noise"), "sigma");
  d.noise.autoregression = json.at("noise").at("autoregression").get<std::vector<double>>();
  d.noise.masked = rows_from(json.at("noise").at("masked"));
  return d;
}

}  // namespace

Diagnosis diagnosis_from_json(std::string_view text, const std::string& path,
                              std::span<const Effect> own_effects) {
  try {
    return diagnosis_from(Json::parse(text), own_effects);
  } catch (const Json::exception& error) {
    throw InputError(
        path, std::string("cannot be read as ") + diagnosis_schema + " (" + error.what() + ")");
  } catch (const InputError& error) {
    throw InputError(path, error.diagnostics().front().message);
  }
}

}  // namespace trueaxis
