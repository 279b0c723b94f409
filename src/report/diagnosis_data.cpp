// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "diagnose/files/pattern_text.hpp"
#include "report/report_data.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using nlohmann::json;

json estimate(const Estimate& e) {
  return {{"value", e.value}, {"u", e.u}, {"unit", e.unit}, {"why_not", e.why_not}};
}

json separating(const Separating& s) {
  json others = json::array();
  for (const Separating::Other& o : s.others)
    others.push_back({{"plan", o.plan}, {"after", o.power}, {"minutes", o.minutes}});
  return {{"plan", s.plan},   {"what", s.what},       {"before", s.power_before},
          {"after", s.power}, {"minutes", s.minutes}, {"why_not", s.why_not},
          {"others", others}};
}

std::string title_of(const std::string& effect) {
  const Effect* known = find_effect(effect);
  return known == nullptr ? "" : std::string(known->title);
}

json class_data(const Finding& finding) {
  json members = json::array();
  const auto add = [&](const std::string& id, double probability, bool structural) {
    members.push_back({{"effect", id},
                       {"title", title_of(id)},
                       {"probability", probability},
                       {"structural", structural}});
  };
  add(finding.effect(), finding.probability, false);
  for (const Rival& rival : finding.rivals) add(rival.effect, rival.probability, rival.structural);
  return members;
}

json finding_data(const Finding& finding) {
  json parameters = json::array();
  for (const FitParameter& p : finding.parameters) {
    json parameter = estimate(p.estimate);
    parameter["name"] = p.name;
    parameters.push_back(parameter);
  }
  json data{{"effect", finding.effect()},
            {"title", finding.term.effect->title},
            {"class", class_data(finding)},
            {"parameters", parameters},
            {"alias", finding.alias},
            {"frame", to_string(finding.term.effect->frame)},
            {"p_value", finding.p_value},
            {"rms_mm", finding.rms_mm},
            {"axis_shift", estimate(finding.axis_shift)},
            {"cosmetic", finding.cosmetic}};
  if (finding.separate_with) data["separate_with"] = separating(*finding.separate_with);
  return data;
}

json not_observable_data(const NotObservable& n) {
  json data{{"effect", n.effect},
            {"title", title_of(n.effect)},
            {"why", n.why},
            {"axis_bias", estimate(n.axis_bias_per_unit)},
            {"axis_bias_typical", estimate(n.axis_bias_typical)},
            {"detectable", n.detectable},
            {"detectable_unit", n.detectable_unit}};
  if (n.separate_with) data["separate_with"] = separating(*n.separate_with);
  return data;
}

json noise_data(const NoiseReport& noise) {
  const auto maybe = [](const std::optional<double>& v) { return v.value_or(std::nan("")); };
  return {{"sigma_mm", noise.sigma_mm},
          {"u_sigma_mm", noise.u_sigma_mm},
          {"source", noise.source},
          {"note", noise.note},
          {"autoregression", noise.autoregression},
          {"stationary_mm", maybe(noise.stationary_mm)},
          {"repeated_mm", maybe(noise.repeated_mm)},
          {"revolutions_mm", maybe(noise.revolutions_mm)},
          {"stated_mm", maybe(noise.stated_mm)},
          {"masked", noise.masked.size()},
          {"gaps", noise.gaps},
          {"interruptions", noise.interruptions.size()}};
}

json interval(const Interval& i) { return {{"value", i.value}, {"low", i.low}, {"high", i.high}}; }

json gain_data(const Diagnosis& d) {
  return {{"rms_before_mm", d.gain.rms_before_mm},
          {"rms_after_mm", d.gain.rms_after_mm},
          {"held_out_before_mm", interval(d.gain.held_out_before_mm)},
          {"held_out_after_mm", interval(d.gain.held_out_after_mm)},
          {"held_out_ratio", interval(d.gain.held_out_ratio)},
          {"blocks", d.gain.blocks},
          {"noise_floor_mm", d.gain.noise_floor_mm},
          {"axis_shift", estimate(d.gain.axis_shift)},
          {"coaxiality_before", estimate(d.gain.coaxiality_before)},
          {"coaxiality_after", estimate(d.gain.coaxiality_after)}};
}

/// Lines of the spectrum that have a name: orders of harmonics, found or unexplained.
json lines_data(const Diagnosis& d) {
  json lines = json::array();
  for (const Finding& finding : d.findings) {
    for (const FitParameter& p : finding.parameters) {
      if (p.name == "order" && p.estimate.determined())
        lines.push_back({{"order", p.estimate.value}, {"name", finding.effect()}});
    }
  }
  for (const Unexplained& u : d.unexplained) {
    const double order = std::abs(u.term.pattern.order);
    if (order != 0.0) lines.push_back({{"order", order}, {"name", "unexplained"}});
  }
  return lines;
}

template <class T>
json list_of(const std::vector<T>& items, json (*write)(const T&)) {
  json list = json::array();
  for (const T& item : items) list.push_back(write(item));
  return list;
}

json unexplained_data(const Unexplained& u) {
  return {{"harmonic", harmonic_text(u.term.pattern)},
          {"dependence", dependence_text(u.term.pattern)},
          {"amplitude", estimate(u.amplitude)},
          {"p_value", u.p_value}};
}

json check_data(const QualityCheck& c) {
  return {
      {"effect", c.effect}, {"title", title_of(c.effect)}, {"found", c.found}, {"text", c.text}};
}

}  // namespace

json diagnosis_data(const ProbeStream& stream, const Diagnosis& d, const Resimulation* again) {
  return {{"verdict", to_string(d.verdict)},
          {"status", to_string(d.extended.status)},
          {"message", d.extended.message},
          {"k", d.baseline.coverage_factor},
          {"surface", to_string(d.baseline.surface)},
          {"false_alarm", d.false_alarm},
          {"hypotheses", d.hypotheses},
          {"findings", list_of(d.findings, finding_data)},
          {"unexplained", list_of(d.unexplained, unexplained_data)},
          {"not_observable", list_of(d.not_observable, not_observable_data)},
          {"noise", noise_data(d.noise)},
          {"checks", list_of(d.checks, check_data)},
          {"remarks", d.remarks},
          {"plans", list_of(d.plans, separating)},
          {"gain", gain_data(d)},
          {"simulation", simulation_data(stream, d, again)},
          {"lines", lines_data(d)},
          {"next",
           {{"plan", d.next.plan},
            {"what", d.next.what},
            {"separates", d.next.separates},
            {"before", d.next.power_before},
            {"after", d.next.power_after},
            {"minutes", d.next.minutes},
            {"why_not", d.next.why_not}}}};
}

}  // namespace trueaxis
