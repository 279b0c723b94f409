// SPDX-License-Identifier: Apache-2.0
#include "infer/files/inference_json.hpp"

namespace trueaxis {
namespace {

Json interval(const Interval& i, const char* unit) {
  return {
      {"value", number(i.value)}, {"low", number(i.low)}, {"high", number(i.high)}, {"unit", unit}};
}

Json rival_object(const Rival& rival) {
  Json json{{"effect", rival.effect},
            {"distance", number(rival.distance)},
            {"log_likelihood_ratio", number(rival.log_likelihood_ratio)},
            {"probability", number(rival.probability)},
            {"structural", rival.structural}};
  if (rival.times_usual > 0.0) json["times_usual"] = number(rival.times_usual);
  return json;
}

}  // namespace

Json finding_object(const std::string& effect, const NamedFinding& finding, Json parameters) {
  return {{"effect", effect},
          {"class", finding.members_beside(effect)},
          {"parameters", std::move(parameters)},
          {"p_value", number(finding.p_value)},
          {"probability", number(finding.probability)}};
}

void add_rivals(Json& json, const NamedFinding& finding) {
  json["rms"] = quantity_object(finding.rms_mm, "mm");
  json["rivals"] = list_of(finding.rivals, rival_object);
}

Json detectable_object(const UnseenEffect& unseen) {
  Json json = edge_size(unseen.detectable, unseen.detectable_unit);
  if (!std::isfinite(unseen.detectable)) json["why"] = "no size of it would be found";
  return json;
}

Json check_object(const QualityCheck& check) {
  return {{"effect", check.effect}, {"found", check.found}, {"text", check.text}};
}

Json explained_object(const Explained& gain) {
  return {{"rms_before", quantity_object(gain.rms_before_mm, "mm")},
          {"rms_after", quantity_object(gain.rms_after_mm, "mm")},
          {"held_out_rms_before", interval(gain.held_out_before_mm, "mm")},
          {"held_out_rms_after", interval(gain.held_out_after_mm, "mm")},
          {"held_out_ratio", interval(gain.held_out_ratio, "1")}};
}

void add_tests(Json& json, const Conclusion& conclusion) {
  json["false_alarm"] = number(conclusion.false_alarm);
  json["hypotheses"] = conclusion.hypotheses;
  json["effective_hypotheses"] = number(conclusion.effective_hypotheses);
  json["threshold"] = number(conclusion.threshold);
}

void add_linear(Json& json, std::span<const LinearValue> values, const Covariance& covariance) {
  json["linear"] = list_of(values, [](const LinearValue& one) {
    Json linear = quantity_object(edge_factor(one.unit) * one.value,
                                  one.unit == "rad" ? "deg" : one.unit.c_str());
    linear["name"] = one.name;
    return linear;
  });
  json["covariance"] =
      square_json(covariance.empty() ? 0 : values.size(), [&](std::size_t i, std::size_t j) {
        return edge_factor(values[i].unit) * edge_factor(values[j].unit) * covariance(i, j);
      });
}

}  // namespace trueaxis
