// SPDX-License-Identifier: Apache-2.0
#include "studies/axis_bias/axis_bias_json.hpp"

#include "format/json.hpp"
#include "studies/axis_bias/axis_bias_text.hpp"

namespace trueaxis {

using namespace study;

std::string axis_bias_json(const virtual_lathe::Scenario& scenario,
                           const std::vector<AxisBiasRow>& rows, const std::string& input_hash) {
  Json json{{"schema", "trueaxis.axis_bias/2"},
            {"version", TRUEAXIS_VERSION},
            {"input_hash", input_hash},
            {"scenario", scenario.name}};
  Json effects = Json::array();
  for (const AxisBiasRow& row : rows) {
    const std::string unit = axis_bias_unit(row);
    const auto shift = [&](double value) { return with_unit(value, unit.c_str()); };
    Json one{{"effect", row.of.effect},
             {"form", row.of.form},
             {"size", with_unit(row.of.size * row.of.edge, row.of.unit.c_str())},
             {"alone",
              {{"at_size", shift(row.lathe)},
               {"at_half", shift(row.lathe_half)},
               {"limit", shift(row.limit)},
               {"predicted", shift(row.predicted)},
               {"second_order", shift(row.second_order)},
               {"off", shift(row.off)},
               {"rounding", shift(row.rounding)},
               {"agrees", row.agrees}}}};
    one["stated"] = row.of.stated ? shift(*row.of.stated) : Json(nullptr);
    one["left"] = number(row.left);
    if (row.separable) {
      one["extended"] = {{"at_size", shift(row.extended)},
                         {"at_half", shift(row.extended_half)},
                         {"u_ratio", number(row.u_ratio)}};
    } else {
      one["extended"] = {{"why", "the surface's own parameters absorb it"}};
    }
    effects.push_back(std::move(one));
  }
  json["effects"] = std::move(effects);
  return json_text(json);
}

}  // namespace trueaxis
