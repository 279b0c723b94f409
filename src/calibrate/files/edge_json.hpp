// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/calibration.hpp"

/// What the results of a calibration and of a diagnosis write alike.
namespace trueaxis {

inline Json parameters_json(const std::vector<CalibratedParameter>& parameters) {
  Json json = Json::object();
  for (const CalibratedParameter& one : parameters) json[one.name] = to_json(one.estimate);
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
