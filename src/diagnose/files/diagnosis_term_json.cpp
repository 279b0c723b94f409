// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string_view>

#include "diagnose/files/diagnosis_objects.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// A parameter of TermShape: the name that a term reads it by, its name and unit in the file.
struct ShapeEntry {
  std::string_view name, written;
  const char* unit;
  double (*value)(const TermShape&);
};

constexpr std::array<ShapeEntry, 10> shape_entries{{
    {"order", "order", "1", [](const TermShape& s) { return s.order; }},
    {"lever_from_mm", "lever_from", "mm", [](const TermShape& s) { return s.lever_from_mm; }},
    {"decay_length_mm", "decay_length", "mm", [](const TermShape& s) { return s.decay_length_mm; }},
    {"degree", "degree", "1", [](const TermShape& s) { return double(s.degree); }},
    {"period_mm", "period", "mm", [](const TermShape& s) { return s.period_mm; }},
    {"frequency_hz", "frequency", "Hz", [](const TermShape& s) { return s.frequency_hz; }},
    {"time_constant_s", "time_constant", "s", [](const TermShape& s) { return s.time_constant_s; }},
    {"onset_s", "onset", "s", [](const TermShape& s) { return s.onset_s; }},
    {"reference_x_mm", "reference_x", "mm", [](const TermShape& s) { return s.reference_x_mm; }},
    {"range_mm", "range", "mm", [](const TermShape& s) { return s.range_mm; }},
}};

const ShapeEntry& shape_entry(std::string_view name) {
  for (const ShapeEntry& entry : shape_entries) {
    if (entry.name == name) return entry;
  }
  throw ContractViolation("a shape parameter without a place in the file: " + std::string(name));
}

}  // namespace

Json term_object(const Finding& finding) {
  const Effect* effect = find_effect(finding.effect);
  expects(effect != nullptr, "a finding of the catalogue");
  Json shape = Json::object(), linear = Json::array();
  for (const std::string& name : shape_parameters(effect->term)) {
    const ShapeEntry& entry = shape_entry(name);
    shape[std::string(entry.written)] =
        quantity_object(entry.value(finding.shape), entry.unit, "left open");
  }
  const auto parameters = linear_parameters(effect->term, finding.shape);
  expects(parameters.size() == finding.linear.size(), "a value for every linear parameter");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool angle = parameters[i].unit == "rad";
    const double scale = angle ? 1.0 / rad_per_deg : 1.0;
    Json entry = quantity_object(scale * finding.linear[i],
                                 angle ? "deg" : parameters[i].unit.c_str(), "not determined");
    entry["name"] = parameters[i].name;
    linear.push_back(entry);
  }
  return {{"formula", effect->formula},
          {"slot", to_string(effect->slot)},
          {"shape", shape},
          {"linear", linear}};
}

}  // namespace trueaxis
