// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "diagnose/files/diagnosis_json.hpp"
#include "infer/files/inference_json.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

struct PatternKind {
  Pattern::Kind kind;
  const char* written;
};
constexpr PatternKind pattern_kinds[] = {{Pattern::Kind::fourier_legendre, "fourier_legendre"},
                                         {Pattern::Kind::line, "line"},
                                         {Pattern::Kind::bump, "bump"}};

std::vector<LinearValue> linear_values(const TermValue& term) {
  std::vector<LinearValue> values;
  for (const LinearParameter& one : term.parameters()) values.push_back({one.name, 0.0, one.unit});
  expects(values.size() == term.linear.size(), "a value for every linear parameter");
  for (std::size_t i = 0; i < values.size(); ++i) values[i].value = term.linear[i];
  return values;
}

Json shape_object(const TermValue& term) {
  Json shape = Json::object();
  for (const std::string& name : shape_parameters(term.effect->term)) {
    const NameAndUnit written = name_and_unit(name);
    shape[written.name] = quantity_object(shape_value(term.shape, name), written.unit, "left open");
  }
  return shape;
}

/// The numbers that the kind of pattern has.
Json pattern_object(const Pattern& p) {
  Json json;
  for (const PatternKind& of : pattern_kinds) {
    if (of.kind == p.kind) json["kind"] = of.written;
  }
  json["frame"] = p.spindle ? "spindle" : "part";
  if (p.kind == Pattern::Kind::bump) {
    json["angle"] = with_unit(p.angle_rad / rad_per_deg, "deg");
    json["width"] = with_unit(p.width_rad / rad_per_deg, "deg");
    json["position"] = with_unit(p.position_mm, "mm");
    json["length"] = with_unit(p.length_mm, "mm");
    return json;
  }
  json["order"] = number(p.order);
  json["along"] = p.in_time ? "time" : "z";
  if (p.kind == Pattern::Kind::line)
    json["frequency"] = with_unit(p.frequency, p.in_time ? "Hz" : "1/mm");
  else
    json["degree"] = p.degree;
  return json;
}

double inside_value(const Json& quantity) {
  const double value = quantity.at("value");
  return quantity.at("unit") == "deg" ? value * rad_per_deg : value;
}

Pattern pattern_from(const Json& json) {
  Pattern p;
  const std::string kind = json.at("kind");
  bool known = false;
  for (const PatternKind& of : pattern_kinds) {
    if (kind != of.written) continue;
    p.kind = of.kind;
    known = true;
  }
  if (!known) throw InputError("diagnosis", "no kind of pattern is called `" + kind + "`");
  p.spindle = json.at("frame") == "spindle";
  if (p.kind == Pattern::Kind::bump) {
    p.angle_rad = inside_value(json.at("angle"));
    p.width_rad = inside_value(json.at("width"));
    p.position_mm = inside_value(json.at("position"));
    p.length_mm = inside_value(json.at("length"));
    return p;
  }
  p.order = json.at("order");
  p.in_time = json.at("along") == "time";
  if (p.kind == Pattern::Kind::line)
    p.frequency = inside_value(json.at("frequency"));
  else
    p.degree = json.at("degree");
  return p;
}

/// The value of every linear parameter, by name.
std::vector<double> linear_from(const Json& list, const TermValue& term) {
  std::vector<double> values;
  for (const LinearParameter& parameter : term.parameters()) {
    const auto entry = std::find_if(list.begin(), list.end(), [&](const Json& one) {
      return one.at("name") == parameter.name;
    });
    if (entry == list.end())
      throw InputError("diagnosis", "a term has no `" + parameter.name + "`");
    values.push_back(inside_value(*entry));
  }
  return values;
}

}  // namespace

Json term_object(const TermValue& term) {
  Json json;
  if (term.effect) {
    json = {{"formula", term.effect->formula},
            {"slot", to_string(term.effect->slot)},
            {"shape", shape_object(term)}};
  } else {
    json = {{"pattern", pattern_object(term.pattern)}};
  }
  add_linear(json, linear_values(term), term.covariance);
  return json;
}

TermValue effect_term_from(const std::string& id, const Json& json,
                           std::span<const Effect> own_effects) {
  TermValue term;
  term.effect = find_effect(id, own_effects);
  if (term.effect == nullptr)
    throw InputError("diagnosis", "the catalogue has no `" + id +
                                      "`: what names an effect of a program's own is read by that "
                                      "program alone");
  for (const std::string& name : shape_parameters(term.effect->term))
    set_shape_value(term.shape, name, inside_value(json.at("shape").at(name_and_unit(name).name)));
  term.linear = linear_from(json.at("linear"), term);
  return term;
}

TermValue pattern_term_from(const Json& json) {
  TermValue term;
  term.pattern = pattern_from(json.at("pattern"));
  term.linear = linear_from(json.at("linear"), term);
  return term;
}

}  // namespace trueaxis
