// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "support/places.hpp"

/// The shipped machine of five axes with a tilting table, and its errors, as commands get them.
namespace trueaxis::testing {

inline const std::string five_axis_data = places::source() + "/data/five_axis/";
inline const std::string of_trunnion = "--machine " + five_axis_data +
                                       "trunnion_ac.toml --errors " + five_axis_data +
                                       "trunnion_ac_errors.toml ";

/// Of a quantity in a result.
inline double value_of(const nlohmann::json& quantity) { return quantity.at("value"); }

}  // namespace trueaxis::testing
