// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/calibration.hpp"

/// What the results of a calibration and of a diagnosis write alike.
namespace trueaxis {

/// A size in mm or rad as files have it: mm or degrees.
inline Json edge_size(double value, const std::string& unit) {
  return unit == "rad" ? with_unit(value / rad_per_deg, "deg") : with_unit(value, unit.c_str());
}

inline Json edge(const Estimate& inside) {
  const bool angle = inside.unit == "rad";
  const double factor = angle ? 1.0 / rad_per_deg : 1.0;
  Estimate out = inside;
  out.value *= factor;
  out.u *= factor;
  if (angle) out.unit = "deg";
  return to_json(out);
}

inline Json parameters_json(const std::vector<CalibratedParameter>& parameters) {
  Json json = Json::object();
  for (const CalibratedParameter& one : parameters) json[one.name] = edge(one.estimate);
  return json;
}

inline Json inputs_json(const Calibration& c) {
  Json list = Json::array();
  for (std::size_t i = 0; i < c.sources.size(); ++i)
    list.push_back({{"file", c.sources[i]}, {"hash", c.input_hashes[i]}});
  return list;
}

inline Json not_determined_json(const Calibration& c) {
  Json list = Json::array();
  for (const NotDetermined& one : c.not_determined)
    list.push_back({{"class", one.members}, {"why", one.why}});
  return list;
}

}  // namespace trueaxis
