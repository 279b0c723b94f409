// SPDX-License-Identifier: Apache-2.0
#include "format/json.hpp"
#include "format/text_layout.hpp"
#include "study/axis_bias/files/axis_bias_results.hpp"

namespace trueaxis {
namespace {

using namespace study;
using layout::format;

/// Of a shift in mm per unit of the effect.
std::string unit_of(const AxisBiasRow& row) {
  return row.of.unit == "1" ? "mm" : "mm/" + row.of.unit;
}

std::string cell(double value) { return std::isfinite(value) ? format("%.9g", value) : ""; }

}  // namespace

std::string axis_bias_csv(const std::vector<AxisBiasRow>& rows) {
  std::string text =
      "effect,form,unit,size,lathe,lathe_half,limit,predicted,second_order,off,rounding,agrees,"
      "stated,"
      "left,separable,u_ratio,extended,extended_half\n";
  for (const AxisBiasRow& row : rows) {
    text += row.of.effect + ",\"" + row.of.form + "\"," + unit_of(row);
    for (const double value : {row.of.size * row.of.edge, row.lathe, row.lathe_half, row.limit,
                               row.predicted, row.second_order, row.off, row.rounding})
      text += ',' + cell(value);
    text += row.agrees ? ",1," : ",0,";
    text += (row.of.stated ? cell(*row.of.stated) : "") + ',' + cell(row.left);
    text += row.separable ? ",1" : ",0";
    for (const double value : {row.u_ratio, row.extended, row.extended_half})
      text += row.separable ? ',' + cell(value) : ",";
    text += '\n';
  }
  return text;
}

std::string axis_bias_json(const virtual_lathe::Scenario& scenario,
                           const std::vector<AxisBiasRow>& rows, const std::string& input_hash) {
  Json json{{"schema", "trueaxis.axis_bias/1"},
            {"version", TRUEAXIS_VERSION},
            {"input_hash", input_hash},
            {"scenario", scenario.name}};
  Json effects = Json::array();
  for (const AxisBiasRow& row : rows) {
    const std::string unit = unit_of(row);
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
