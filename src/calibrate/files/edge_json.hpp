// SPDX-License-Identifier: Apache-2.0
#pragma once

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

inline Json inputs_json(const Calibration& c) { return files_json(c.sources, c.input_hashes); }

inline Json not_determined_json(const Calibration& c) {
  return list_of(c.not_determined, [](const NotDetermined& one) -> Json {
    return {{"class", one.members}, {"why", one.why}};
  });
}

}  // namespace trueaxis
