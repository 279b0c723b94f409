// SPDX-License-Identifier: Apache-2.0
#include "report/readings_data.hpp"

#include "report/chart_readings.hpp"
#include "report/sections_data.hpp"
#include "report/thinning.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t envelope_bins = 400;

Json every_reading(const ChartReadings& all) {
  Json points{{"c_deg", column(all.c_deg, 3)},
              {"deviation_um", column(all.deviation_um, 3)},
              {"rejected", Json::array()}};
  if (all.has_position) points["position_mm"] = column(all.position_mm, 4);
  if (!all.time_s.empty()) points["time_s"] = column(all.time_s, 4);
  if (all.has_model) points["residual_um"] = column(all.residual_um, 3);
  for (std::size_t i = 0; i < all.kept.size(); ++i) {
    if (!all.kept[i]) points["rejected"].push_back(i);
  }
  return points;
}

Json envelope(const ChartReadings& all, const std::vector<double>& x, Bins bins) {
  Envelope found(bins);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (all.kept[i]) found.add(x[i], all.residual_um[i]);
  }
  return found.to_json(3);
}

Json cells(const ChartReadings& all) {
  const Bins rows = map_rows(all);
  CellMeans deviation(map_columns, rows), residual(map_columns, rows);
  for (std::size_t i = 0; i < all.kept.size(); ++i) {
    if (!all.kept[i]) continue;
    deviation.add(all.c_deg[i], all.position_mm[i], all.deviation_um[i]);
    if (all.has_model) residual.add(all.c_deg[i], all.position_mm[i], all.residual_um[i]);
  }
  Json map{{"columns", map_columns.count},
           {"rows", rows.count},
           {"position_min_mm", rows.low},
           {"position_max_mm", rows.high},
           {"deviation_um", deviation.to_json(3)}};
  if (all.has_model) map["residual_um"] = residual.to_json(3);
  return map;
}

Json envelopes(const ChartReadings& all) {
  Json found{{"c", envelope(all, all.c_deg, {0.0, 360.0, envelope_bins})}};
  if (all.has_position) {
    found["position"] = envelope(all, all.position_mm, bins_over(all.position_mm, envelope_bins));
  }
  std::vector<double> number(all.kept.size());
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(i + 1);
  const std::vector<double>& order = all.time_s.empty() ? number : all.time_s;
  found["time"] = envelope(all, order, bins_over(order, envelope_bins));
  return found;
}

std::vector<double> kept_residuals(const ChartReadings& all) {
  std::vector<double> values;
  for (std::size_t i = 0; i < all.kept.size(); ++i) {
    if (all.kept[i] && all.has_model) values.push_back(all.residual_um[i]);
  }
  return values;
}

}  // namespace

Json readings_data(const ProbeStream& stream, const FitResult& fit) {
  const CoaxialNominal nominal(stream, fit);
  const ChartReadings all = chart_readings(stream, fit, nominal);
  const bool thinned = stream.size() > max_points;
  Json data{{"count", stream.size()},
            {"thinned", thinned},
            {"per_turn", all.readings_per_turn},
            {"face", stream.kind == StreamKind::face},
            {"has_position", all.has_position},
            {"has_time", !all.time_s.empty()},
            {"has_model", all.has_model},
            {"sections", sections_data(all, nominal)},
            {"histogram", histogram(kept_residuals(all), 3)}};
  if (stream.size() == 0) return data;
  if (!thinned) {
    data["points"] = every_reading(all);
    return data;
  }
  if (all.has_position) data["cells"] = cells(all);
  if (all.has_model) data["envelopes"] = envelopes(all);
  return data;
}

}  // namespace trueaxis
