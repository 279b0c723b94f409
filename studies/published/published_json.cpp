// SPDX-License-Identifier: Apache-2.0
#include "studies/published/published_json.hpp"

#include "format/json.hpp"

namespace trueaxis {
namespace {

using namespace study;

Json ends_json(const Ends& ends) { return Json::array({number(ends.low), number(ends.high)}); }

Json by_parameter(const Published& published, const std::vector<double>& values) {
  Json json;
  for (std::size_t i = 0; i < values.size(); ++i) json[published.parameters[i]] = number(values[i]);
  return json;
}

Json rows_json(const Published& published) {
  Json rows = Json::array();
  for (const PublishedRow& row : published.rows) {
    Json printed;
    for (std::size_t i = 0; i < row.values.size(); ++i)
      printed[published.parameters[i]] = row.values[i].text;
    rows.push_back({{"name", row.name}, {"printed", printed}});
  }
  return rows;
}

Json reading_json(const Published& published, const PublishedReading& reading,
                  const PlacedReading& placed) {
  Json runs = Json::array();
  for (const PlacedRow& row : placed.rows) {
    runs.push_back({{"row", row.row},
                    {"error", by_parameter(published, row.error)},
                    {"in_sd", by_parameter(published, row.in_sd)},
                    {"chi_squared", number(row.chi_squared)},
                    {"p_value", number(row.p_value)},
                    {"log_likelihood", number(row.log_likelihood)}});
  }
  Json factor{{"value", number(placed.noise_factor)}, {"estimated", reading.fit_noise}};
  if (reading.fit_noise) factor["interval_95"] = ends_json(placed.noise_factor_95);
  return {{"name", reading.name},
          {"log_likelihood", number(placed.log_likelihood)},
          {"gain", number(placed.gain)},
          {"chi_squared", number(placed.chi_squared)},
          {"degrees_of_freedom", placed.rows.size() * published.parameters.size()},
          {"p_value", number(placed.p_value)},
          {"noise_factor", factor},
          {"runs", runs}};
}

Json unknown_json(const GridAxis& axis, const UnknownLevel& unknown) {
  Json points = Json::array();
  for (const UnknownLevel::AtPoint& point : unknown.points)
    points.push_back({{"level", number(point.level)}, {"below_best", number(point.below_best)}});
  return {{"row", unknown.row},
          {"reading", unknown.reading},
          {"path", axis.points.front().settings.front().path},
          {"best", number(unknown.best)},
          {"interval_95", ends_json(unknown.interval_95)},
          {"log_likelihood", points}};
}

}  // namespace

std::string published_json(const Sweep& sweep, const Published& published,
                           const Placement& placement) {
  Json json{{"schema", "trueaxis.published/1"},
            {"version", TRUEAXIS_VERSION},
            {"input_hash", sweep.input_hash},
            {"source", published.source},
            {"rows", rows_json(published)}};
  if (!placement.why_not.empty()) {
    json["why"] = placement.why_not;
    return json_text(json);
  }
  Json readings = Json::array(), unknown = Json::array(), among = Json::array();
  for (std::size_t i = 0; i < placement.readings.size(); ++i)
    readings.push_back(reading_json(published, published.readings[i], placement.readings[i]));
  for (const UnknownLevel& one : placement.unknown)
    unknown.push_back(unknown_json(sweep.axes[*published.rows[one.row].unknown_axis], one));
  for (const AmongRepeats& one : placement.among) {
    among.push_back({{"row", one.row},
                     {"cell", one.cell},
                     {"share_below", by_parameter(published, one.share_below)},
                     {"share_as_far", number(one.share_as_far)}});
  }
  json["readings"] = std::move(readings);
  json["among_repeats"] = std::move(among);
  json["unknown_levels"] = std::move(unknown);
  return json_text(json);
}

}  // namespace trueaxis
