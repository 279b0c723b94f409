// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "report/chart_readings.hpp"
#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Indices = std::vector<std::size_t>;

Indices kept_indices(const ChartReadings& all) {
  Indices kept;
  for (std::size_t i = 0; i < all.kept.size(); ++i) {
    if (all.kept[i]) kept.push_back(i);
  }
  return kept;
}

/// The `count` readings nearest to a height, in the order of C; ties go to the earlier reading.
Indices nearest(const ChartReadings& all, Indices from, double position_mm, std::size_t count) {
  const auto distance = [&](std::size_t i) { return std::abs(all.position_mm[i] - position_mm); };
  const auto closer = [&](std::size_t a, std::size_t b) {
    return distance(a) != distance(b) ? distance(a) < distance(b) : a < b;
  };
  count = std::min(count, from.size());
  std::partial_sort(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count), from.end(),
                    closer);
  from.resize(count);
  std::sort(from.begin(), from.end(), [&](std::size_t a, std::size_t b) {
    return all.c_deg[a] != all.c_deg[b] ? all.c_deg[a] < all.c_deg[b] : a < b;
  });
  return from;
}

/// `um` of the readings of a section over C.
Json measured(const ChartReadings& all, const Indices& section, const std::vector<double>& um) {
  std::vector<double> c_deg, value;
  if (section.size() <= 360) {
    for (const std::size_t i : section) {
      c_deg.push_back(all.c_deg[i]);
      value.push_back(um[i]);
    }
    return {{"c_deg", column(c_deg, 3)}, {"um", column(value, 3)}, {"averaged", false}};
  }
  const Bins degrees{0.0, 360.0, 360};
  std::vector<double> sum(degrees.count, 0.0), in_bin(degrees.count, 0.0);
  for (const std::size_t i : section) {
    sum[degrees.of(all.c_deg[i])] += um[i];
    in_bin[degrees.of(all.c_deg[i])] += 1.0;
  }
  for (std::size_t bin = 0; bin < degrees.count; ++bin) {
    if (in_bin[bin] == 0.0) continue;
    c_deg.push_back(degrees.center(bin));
    value.push_back(sum[bin] / in_bin[bin]);
  }
  return {{"c_deg", column(c_deg, 3)}, {"um", column(value, 3)}, {"averaged", true}};
}

Json curve(const CoaxialNominal& nominal, double position_mm) {
  std::vector<double> value;
  for (int degree = 0; degree <= 360; degree += 3) {
    value.push_back(nominal.model_deviation_mm(degree * rad_per_deg, position_mm) / mm_per_um);
  }
  return {{"step_deg", 3}, {"um", column(value, 3)}};
}

/// @param found_um what was found adds to each reading; empty: nothing
Json section_at(const ChartReadings& all, const CoaxialNominal& nominal, const Indices& kept,
                double position_mm, const std::vector<double>& found_um) {
  const std::size_t wanted = static_cast<std::size_t>(std::max(24.0, all.readings_per_turn));
  const Indices section = nearest(all, kept, position_mm, all.has_position ? wanted : kept.size());
  double half_width = 0.0;
  for (const std::size_t i : section) {
    half_width = std::max(half_width, std::abs(all.position_mm[i] - position_mm));
  }
  Json data{{"position_mm", rounded(position_mm, 3)},
            {"half_width_mm", rounded(half_width, 3)},
            {"nominal_mm", rounded(nominal.reading_mm(position_mm), 4)},
            {"readings", section.size()},
            {"measured", measured(all, section, all.deviation_um)}};
  if (all.has_model) data["residual"] = measured(all, section, all.residual_um);
  if (!found_um.empty()) data["found"] = measured(all, section, found_um);
  if (nominal.from_fit()) data["model"] = curve(nominal, position_mm);
  return data;
}

/// Up to three polar sections (both ends and the middle): the readings of about one revolution
/// nearest to each height, means per degree where there are more than 360, and the model's curve
/// there.
Json sections_data(const ChartReadings& all, const CoaxialNominal& nominal,
                   const std::vector<double>& found_um) {
  Json sections = Json::array();
  const Indices kept = kept_indices(all);
  if (kept.empty()) return sections;
  double low = all.position_mm[kept.front()], high = low;
  for (const std::size_t i : kept) {
    low = std::min(low, all.position_mm[i]);
    high = std::max(high, all.position_mm[i]);
  }
  if (!(high > low)) {
    sections.push_back(section_at(all, nominal, kept, low, found_um));
    return sections;
  }
  for (const double share : {0.05, 0.5, 0.95}) {
    sections.push_back(section_at(all, nominal, kept, low + share * (high - low), found_um));
  }
  return sections;
}

/// What the causes add to the ideal fit at each reading, µm; empty if nothing was found or it is
/// not known for every reading.
std::vector<double> found_um(const Diagnosis* diagnosis, const ChartReadings& all) {
  if (diagnosis == nullptr || (diagnosis->findings.empty() && diagnosis->unexplained.empty()))
    return {};
  const auto &before = diagnosis->residual_before_mm, &after = diagnosis->residual_after_mm;
  if (!all.has_model || before.size() != all.kept.size() || after.size() != all.kept.size())
    return {};
  std::vector<double> um;
  for (std::size_t i = 0; i < before.size(); ++i) um.push_back((before[i] - after[i]) / mm_per_um);
  return um;
}

constexpr std::size_t envelope_bins = 400;

Json every_reading(const ChartReadings& all) {
  Json points{{"c_deg", column(all.c_deg, 3)},
              {"deviation_um", column(all.deviation_um, 3)},
              {"rejected", all.rejected()}};
  if (all.has_position) points["position_mm"] = column(all.position_mm, 4);
  if (!all.time_s.empty()) points["time_s"] = column(all.time_s, 4);
  if (all.has_model) points["residual_um"] = column(all.residual_um, 3);
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

Json readings_data(const ProbeStream& stream, const FitResult& fit, const Diagnosis* diagnosis) {
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
            {"sections", sections_data(all, nominal, found_um(diagnosis, all))},
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
