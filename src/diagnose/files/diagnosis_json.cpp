// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/diagnosis_json.hpp"

#include <limits>

#include "diagnose/files/diagnosis_text.hpp"
#include "effect/short_name.hpp"
#include "fit/files/fit_files.hpp"
#include "infer/files/inference_json.hpp"

namespace trueaxis {
namespace {

Json length(double value_mm) { return quantity_object(value_mm, "mm"); }

Json separating_object(const Separating& s) {
  const auto other = [](const Separating::Other& o) -> Json {
    return {{"plan", o.plan},
            {"what", o.what},
            {"power", number(o.power)},
            {"minutes", number(o.minutes)}};
  };
  return {{"plan", s.plan},
          {"others", list_of(s.others, other)},
          {"what", s.what},
          {"power", number(s.power)},
          {"power_before", number(s.power_before)},
          {"minutes", number(s.minutes)},
          {"why_not", s.why_not}};
}

Json maybe(const std::optional<Separating>& separating) {
  return separating ? separating_object(*separating) : Json(nullptr);
}

Json whole_finding(const Finding& finding) {
  Json json = finding_summary(finding);
  json["alias"] = finding.alias;
  json["name"] = short_name(*finding.term.effect);
  json["frame"] = to_string(finding.term.effect->frame);
  add_rivals(json, finding);
  json["separate_with"] = maybe(finding.separate_with);
  json["term"] = term_object(finding.term);
  return json;
}

/// What follows from each cause of a class.
Json consequences_object(const Diagnosis& d) {
  Json json = Json::object();
  for (const Finding& finding : d.findings)
    for (const std::string& id : finding.members())
      if (const Effect* effect = d.entry(id); effect && !effect->consequence.empty())
        json[id] = effect->consequence;
  return json;
}

Json unexplained_object(const Unexplained& u) {
  Json json = unexplained_summary(u);
  json["p_value"] = number(u.p_value);
  json["term"] = term_object(u.term);
  return json;
}

Json not_observable_object(const NotObservable& n) {
  return {{"effect", n.effect},
          {"why", n.why},
          {"axis_bias_per_unit", estimate_object(n.axis_bias_per_unit)},
          {"axis_bias_typical", estimate_object(n.axis_bias_typical)},
          {"detectable", detectable_object(n)},
          {"separate_with", maybe(n.separate_with)}};
}

Json gain_object(const Gain& gain) {
  Json json = explained_object(gain);
  json["blocks"] = gain.blocks;
  json["noise_floor"] = length(gain.noise_floor_mm);
  json["axis_shift"] = estimate_object(gain.axis_shift);
  json["coaxiality_before"] = estimate_object(gain.coaxiality_before);
  json["coaxiality_after"] = estimate_object(gain.coaxiality_after);
  return json;
}

Json next_object(const NextMeasurement& next) {
  return {{"plan", next.plan},
          {"what", next.what},
          {"separates", next.separates},
          {"power_before", number(next.power_before)},
          {"power_after", number(next.power_after)},
          {"minutes", number(next.minutes)},
          {"why_not", next.why_not}};
}

Json spectrum_object(const std::vector<SpectrumBin>& spectrum) {
  const auto column = [&](double SpectrumBin::*of) {
    return list_of(spectrum, [of](const SpectrumBin& bin) { return number(bin.*of); });
  };
  return {{"order", column(&SpectrumBin::order)},
          {"before", column(&SpectrumBin::before_mm)},
          {"after", column(&SpectrumBin::after_mm)},
          {"unit", "mm"}};
}

Json options_object(const Diagnosis& d) {
  return {{"surface", to_string(d.baseline.surface)},
          {"feature", d.baseline.bore ? "bore" : "shaft"},
          {"loss", to_string(d.baseline.loss)},
          {"coverage_factor", number(d.baseline.coverage_factor)},
          {"false_alarm", number(d.false_alarm)},
          {"known", list_of(d.known, [](const Influence& one) -> Json {
             return {{"key", info_of(one.kind).key}, {"value", one.value}, {"u", one.u}};
           })}};
}

Json maybe_length(const std::optional<double>& value_mm) {
  return value_mm ? length(*value_mm)
                  : Json{{"value", nullptr}, {"unit", "mm"}, {"why", "the data have no such part"}};
}

}  // namespace

Json estimate_object(const Estimate& estimate) {
  Json json = to_json(estimate);
  const bool complete = std::isfinite(estimate.value) && std::isfinite(estimate.u);
  if (!complete && estimate.why_not.empty()) {
    json["why"] = estimate.determined() ? "its uncertainty is not determined" : "not determined";
  }
  return json;
}

Json finding_summary(const Finding& finding) {
  Json parameters = Json::object();
  for (const FitParameter& p : finding.parameters) {
    parameters[p.name] = estimate_object(p.estimate);
  }
  Json json = finding_object(finding.effect(), finding, std::move(parameters));
  json["axis_bias"] = {{"axis_shift", estimate_object(finding.axis_shift)},
                       {"cosmetic", finding.cosmetic}};
  return json;
}

Json unexplained_summary(const Unexplained& u) {
  return {{"harmonic", harmonic_text(u.term.pattern)},
          {"dependence", dependence_text(u.term.pattern)},
          {"amplitude", estimate_object(u.amplitude)}};
}

Json diagnosis_summary(const Diagnosis& d) {
  return {{"schema", diagnosis_schema},
          {"verdict", to_string(d.verdict)},
          {"line", diagnosis_line(d)},
          {"findings", list_of(d.findings, finding_summary)},
          {"unexplained", list_of(d.unexplained, unexplained_summary)},
          {"axis_shift", estimate_object(d.gain.axis_shift)},
          {"next_measurement", d.next.plan}};
}

Json share_object(const AxisShare& share) {
  return {{"effect", share.effect},
          {"instead_of", share.instead_of},
          {"probability", number(share.probability)},
          {"axis_shift", estimate_object(share.axis_shift)}};
}

Json limit_object(const AxisLimit& limit) {
  return {
      {"effect", limit.effect}, {"instead_of", limit.instead_of}, {"share", number(limit.share)}};
}

Json diagnosis_object(const Diagnosis& d) {
  Json json;
  json["schema"] = diagnosis_schema;
  json["version"] = TRUEAXIS_VERSION;
  json["input"] = fit_object(d.baseline).at("input");
  json["options"] = options_object(d);
  json["verdict"] = to_string(d.verdict);
  json["baseline"] = fit_object(d.baseline);
  json["named"] = fit_object(d.named);
  json["extended"] = fit_object(d.extended);
  json["shares"] = list_of(d.shares, share_object);
  json["limits"] = list_of(d.limits, limit_object);
  json["u_frame"] = {{"z_mid", length(d.z_mid_mm)}, {"z_half", length(d.z_half_mm)}};
  json["findings"] = list_of(d.findings, whole_finding);
  json["consequences"] = consequences_object(d);
  json["unexplained"] = list_of(d.unexplained, unexplained_object);
  json["not_observable"] = list_of(d.not_observable, not_observable_object);
  json["remarks"] = d.remarks;
  json["noise"] = noise_object(d.noise);
  json["checks"] = list_of(d.checks, check_object);
  json["gain"] = gain_object(d.gain);
  json["next_measurement"] = next_object(d.next);
  json["plans"] = list_of(d.plans, separating_object);
  add_tests(json, d);
  json["spectrum"] = spectrum_object(d.spectrum);
  return json;
}

std::string diagnosis_json(const Diagnosis& diagnosis) {
  return json_text(diagnosis_object(diagnosis));
}

// The impulse response ψ_k = Σ φ_j ψ_{k−j} gives γ(1)/γ(0) = Σ ψ_k ψ_{k+1} / Σ ψ_k².
double neighbour_correlation(const std::vector<double>& autoregression) {
  constexpr std::size_t most = 100000;  // a root of 0.9999 has died out by then
  std::vector<double> response{1.0};
  double lag_0 = 1.0, lag_1 = 0.0, last = 1.0;
  for (std::size_t k = 1; k < most && last > 1e-24 * lag_0; ++k) {
    double next = 0.0;
    for (std::size_t j = 1; j <= autoregression.size() && j <= k; ++j) {
      next += autoregression[j - 1] * response[k - j];
    }
    lag_1 += next * response.back();
    lag_0 += next * next;
    response.push_back(next);
    last = 0.0;  // of a whole order's span: one of them may happen to be 0
    for (std::size_t j = 0; j < autoregression.size() && j < response.size(); ++j) {
      last += response[k - j] * response[k - j];
    }
    if (!(lag_0 < 1e12)) return std::numeric_limits<double>::quiet_NaN();
  }
  return lag_1 / lag_0;
}

Json noise_object(const NoiseReport& noise) {
  return {{"sigma", estimate_object({noise.sigma_mm, noise.u_sigma_mm, "mm", ""})},
          {"source", to_string(noise.source)},
          {"note", noise.note},
          {"autocorrelation", number(neighbour_correlation(noise.autoregression))},
          {"autoregression", noise.autoregression},
          {"stationary", maybe_length(noise.stationary_mm)},
          {"repeated", maybe_length(noise.repeated_mm)},
          {"revolutions", maybe_length(noise.revolutions_mm)},
          {"stated", maybe_length(noise.stated_mm)},
          {"masked", rejected_json(noise.masked)},
          {"gaps", noise.gaps},
          {"interruptions", rejected_json(noise.interruptions)}};
}

}  // namespace trueaxis
