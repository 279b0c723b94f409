// SPDX-License-Identifier: Apache-2.0
#include "effect/files/effects_files.hpp"
#include "format/json.hpp"
#include "format/units.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

Json parameter_object(const EffectParameter& parameter) {
  const bool angle = parameter.unit == "rad";
  const double scale = angle ? 1.0 / rad_per_deg : 1.0;
  Json json{{"name", parameter.name},
            {"unit", angle ? "deg" : parameter.unit},
            {"meaning", parameter.meaning}};
  if (parameter.low != 0.0 || parameter.high != 0.0) {
    json["typical"] = {parameter.low * scale, parameter.high * scale};
  }
  const EffectParameter any{};
  if (parameter.least != any.least) json["least"] = parameter.least * scale;
  if (parameter.most != any.most) json["most"] = parameter.most * scale;
  return json;
}

/// What a scenario's [[effect]] takes; a key without a default must be given.
Json scenario_keys_json(std::string_view id) {
  Json keys = Json::array();
  for (const virtual_lathe::EffectKind& kind : virtual_lathe::effect_kinds()) {
    if (kind.id != id) continue;
    for (const virtual_lathe::LatheParameter& key : kind.parameters) {
      const KeySpelling usual = key_spellings(key.name).front();
      Json one{{"key", usual.key}};
      one["default"] = key.fallback ? Json(*key.fallback / usual.factor) : Json(nullptr);
      keys.push_back(one);
    }
  }
  return keys;
}

Json effect_object(const Effect& effect) {
  const auto separation = [](const Separation& s) -> Json {
    return {{"measurement", s.code}, {"how", s.how}};
  };
  Json json{{"id", effect.id},
            {"title", effect.title},
            {"check", effect.check.has_value()},
            {"slot", to_string(effect.slot)},
            {"frame", to_string(effect.frame)},
            {"formula", effect.formula},
            {"parameters", list_of(effect.parameters, parameter_object)},
            {"scenario_keys", scenario_keys_json(effect.id)},
            {"signature", effect.signature},
            {"consequence", effect.consequence},
            {"confounders", effect.confounders},
            {"absorbed_by", effect.absorbed_by},
            {"separations", list_of(effect.separations, separation)}};
  if (effect.axis_bias) {
    json["axis_bias_per_unit"] = {{"value", effect.axis_bias->value},
                                  {"unit", effect.axis_bias->unit},
                                  {"text", effect.axis_bias->text}};
  }
  if (effect.needs.stream)
    json["seen_on"] = *effect.needs.stream == StreamKind::face ? "face" : "lateral";
  json["source"] = effect.source;
  return json;
}

}  // namespace

std::string effects_json(const std::vector<const Effect*>& effects) {
  Json json;
  json["schema"] = "trueaxis.effects/1";
  json["version"] = TRUEAXIS_VERSION;
  json["effects"] = list_of(effects, [](const Effect* effect) { return effect_object(*effect); });
  Json measurements = Json::object();
  for (const Separator& separator : separators()) {
    measurements[std::string(separator.code)] = separator.what;
  }
  json["measurements"] = measurements;
  return json.dump(2) + "\n";
}

}  // namespace trueaxis
