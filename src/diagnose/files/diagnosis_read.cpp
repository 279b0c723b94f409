// SPDX-License-Identifier: Apache-2.0

#include "diagnose/files/diagnosis_json.hpp"
#include "fit/files/fit_files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

double value(const Json& object, const char* key) { return object.at(key).at("value"); }

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
                              number_from(rival.at("log_likelihood_ratio")),
                              number_from(rival.at("probability")), rival.at("structural"),
                              rival.value("times_usual", 0.0)});
  }
  for (const auto& [name, estimate] : json.at("parameters").items())
    finding.parameters.push_back({name, estimate_from(estimate)});
  finding.p_value = number_from(json.at("p_value"));
  finding.probability = number_from(json.at("probability"));
  finding.axis_shift = estimate_from(json.at("axis_bias").at("axis_shift"));
  finding.cosmetic = json.at("axis_bias").at("cosmetic");
  return finding;
}

Separating separating_from(const Json& json) {
  Separating s;
  s.plan = json.at("plan"), s.what = json.at("what"), s.why_not = json.at("why_not");
  s.power = number_from(json.at("power")), s.power_before = number_from(json.at("power_before"));
  s.minutes = number_from(json.at("minutes"));
  return s;
}

NotObservable not_observable_from(const Json& json) {
  NotObservable n;
  n.effect = json.at("effect"), n.why = json.at("why");
  if (!json.at("separate_with").is_null())
    n.separate_with = separating_from(json.at("separate_with"));
  return n;
}

AxisShare share_from(const Json& json) {
  return {json.at("effect"), json.at("instead_of"), number_from(json.at("probability")),
          estimate_from(json.at("axis_shift"))};
}

/// What a verdict asks of the noise.
NoiseReport noise_from(const Json& json) {
  NoiseReport noise;
  noise.sigma_mm = value(json, "sigma");
  noise.u_sigma_mm = number_from(json.at("sigma").at("u"));
  if (!json.at("stated").at("value").is_null()) noise.stated_mm = value(json, "stated");
  noise.autoregression = json.at("autoregression").get<std::vector<double>>();
  noise.masked = rejected_from(json.at("masked"));
  return noise;
}

Unexplained unexplained_from(const Json& json) {
  return {{estimate_from(json.at("amplitude")), number_from(json.at("p_value"))},
          pattern_term_from(json.at("term"))};
}

Influence influence_from(const Json& json) {
  const auto key = json.at("key").get<std::string>();
  const auto info = std::ranges::find(influence_catalogue(), key, &InfluenceInfo::key);
  if (info == influence_catalogue().end())
    throw InputError("diagnosis", "nothing that may be known is called `" + key + "`");
  return {info->kind, json.at("u"), json.at("value")};
}

Diagnosis diagnosis_from(const Json& json, std::span<const Effect> own_effects) {
  if (json.at("schema") != diagnosis_schema)
    throw InputError("diagnosis", std::string("its schema is not ") + diagnosis_schema +
                                      ": write one with 'trueaxis diagnose --json'");
  Diagnosis d;
  d.own_effects = own_effects;
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
  d.noise = noise_from(json.at("noise"));
  d.gain.rms_after_mm = number_from(json.at("gain").at("rms_after").at("value"));
  for (const Json& share : json.at("shares")) d.shares.push_back(share_from(share));
  for (const Json& hidden : json.at("not_observable"))
    d.not_observable.push_back(not_observable_from(hidden));
  for (const Json& plan : json.at("plans")) d.plans.push_back(separating_from(plan));
  if (json.at("options").contains("known"))  // version 0.1.0 did not write them
    for (const Json& one : json["options"]["known"]) d.known.push_back(influence_from(one));
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
