// SPDX-License-Identifier: Apache-2.0
#include "studies/published/published_page.hpp"

extern "C" {
extern const char trueaxis_published_js_begin[], trueaxis_published_js_end[];
}

namespace trueaxis {
namespace {

using namespace study;
using nlohmann::json;

json column(const std::vector<double>& values) {
  json out = json::array();
  for (const double value : values) out.push_back(to_six_digits(value));
  return out;
}

/// A printed run; its place among the repeats where its cell is known.
json run_data(const Published& published, const Placement& placement, std::size_t row) {
  json printed = json::array();
  for (const PrintedNumber& number : published.rows[row].values) printed.push_back(number.text);
  json data{{"name", published.rows[row].name}, {"printed", printed}};
  for (const AmongRepeats& among : placement.among) {
    if (among.row != row) continue;
    data["cell"] = among.cell;
    data["share_below"] = column(among.share_below);
    data["share_as_far"] = to_six_digits(among.share_as_far);
  }
  return data;
}

json reading_data(const PublishedReading& reading, const PlacedReading& placed) {
  json runs = json::array();
  for (const PlacedRow& row : placed.rows) {
    runs.push_back({{"row", row.row},
                    {"error", column(row.error)},
                    {"in_sd", column(row.in_sd)},
                    {"chi_squared", to_six_digits(row.chi_squared)},
                    {"p_value", to_six_digits(row.p_value)}});
  }
  return {{"name", reading.name},
          {"gain", to_six_digits(placed.gain)},
          {"chi_squared", to_six_digits(placed.chi_squared)},
          {"p_value", to_six_digits(placed.p_value)},
          {"factor", to_six_digits(placed.noise_factor)},
          {"fitted", reading.fit_noise},
          {"factor_low", to_six_digits(placed.noise_factor_95.low)},
          {"factor_high", to_six_digits(placed.noise_factor_95.high)},
          {"runs", runs}};
}

/// Levels in the unit of the axis' labels.
json unknown_data(const GridAxis& axis, const UnknownLevel& unknown) {
  const double unit = unknown.unit;
  json labels = json::array(), lost = json::array();
  for (std::size_t i = 0; i < unknown.points.size(); ++i) {
    labels.push_back(axis.points[i].label);
    lost.push_back(to_six_digits(unknown.points[i].below_best));
  }
  return {{"row", unknown.row},
          {"reading", unknown.reading},
          {"axis", axis.name},
          {"best", to_six_digits(unknown.best / unit)},
          {"low", to_six_digits(unknown.interval_95.low / unit)},
          {"high", to_six_digits(unknown.interval_95.high / unit)},
          {"labels", labels},
          {"lost", lost}};
}

}  // namespace

std::vector<SweepReportAddition> published_page(const Sweep& sweep, const Published& published,
                                                const Placement& placement) {
  if (!placement.why_not.empty()) return {};
  json data{{"source", published.source},
            {"parameters", published.parameters},
            {"runs", json::array()},
            {"readings", json::array()},
            {"unknown", json::array()}};
  for (std::size_t row = 0; row < published.rows.size(); ++row)
    data["runs"].push_back(run_data(published, placement, row));
  for (std::size_t i = 0; i < placement.readings.size(); ++i)
    data["readings"].push_back(reading_data(published.readings[i], placement.readings[i]));
  for (const UnknownLevel& unknown : placement.unknown)
    data["unknown"].push_back(
        unknown_data(sweep.axes[*published.rows[unknown.row].unknown_axis], unknown));
  const std::string_view script(
      trueaxis_published_js_begin,
      static_cast<std::size_t>(trueaxis_published_js_end - trueaxis_published_js_begin));
  return {{"published", std::move(data), script}};
}

}  // namespace trueaxis
