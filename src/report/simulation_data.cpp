// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "report/chart_readings.hpp"
#include "report/page_data.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

bool complete(const Diagnosis& d, std::size_t count) {
  return count > 0 && d.residual_before_mm.size() == count && d.residual_after_mm.size() == count;
}

/// Readings that the diagnosis excluded, or where the model was not evaluated.
std::vector<bool> masked_readings(const Diagnosis& d) {
  std::vector<bool> masked = marked(d.noise.masked, d.residual_before_mm.size());
  for (std::size_t i = 0; i < masked.size(); ++i) {
    if (!std::isfinite(d.residual_before_mm[i] + d.residual_after_mm[i])) masked[i] = true;
  }
  return masked;
}

/// The model in the place of the virtual lathe.
Resimulation by_model(const ProbeStream& stream, const Diagnosis& d,
                      const std::vector<bool>& masked) {
  Resimulation out;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    out.readings.before_mm.push_back(stream.reading_mm[i] - d.residual_before_mm[i]);
    out.readings.after_mm.push_back(stream.reading_mm[i] - d.residual_after_mm[i]);
  }
  out.comparison = compare(stream, out.readings, masked, d.noise.sigma_mm, d.noise.autoregression);
  return out;
}

/// No more bins than a chart has pixels: the highest of each group stands for it.
Json spectrum_data(const std::vector<SpectrumBin>& bins) {
  constexpr std::size_t most = 1000;
  const std::size_t group = (bins.size() + most - 1) / most;
  std::vector<double> order, before, after;
  for (std::size_t i = 0; i < bins.size(); i += group) {
    const std::size_t end = std::min(bins.size(), i + group);
    SpectrumBin highest = bins[i];
    for (std::size_t j = i; j < end; ++j) {
      if (bins[j].before_mm > highest.before_mm) highest.order = bins[j].order;
      highest.before_mm = std::max(highest.before_mm, bins[j].before_mm);
      highest.after_mm = std::max(highest.after_mm, bins[j].after_mm);
    }
    order.push_back(highest.order);
    before.push_back(highest.before_mm / mm_per_um);
    after.push_back(highest.after_mm / mm_per_um);
  }
  return {{"order", column(order, 5)},
          {"before_um", column(before, 4)},
          {"after_um", column(after, 4)},
          {"grouped", group > 1}};
}

std::vector<double> difference_um(const std::vector<double>& measured_mm,
                                  const std::vector<double>& simulated_mm) {
  std::vector<double> um;
  um.reserve(measured_mm.size());
  for (std::size_t i = 0; i < measured_mm.size(); ++i)
    um.push_back((measured_mm[i] - simulated_mm[i]) / mm_per_um);
  return um;
}

/// A column of a map: one value a reading, or means of cells.
Json map_column(const ChartReadings& all, const std::vector<double>& um, bool thinned) {
  if (!thinned) return column(um, 3);
  CellMeans cells(map_columns, map_rows(all));
  for (std::size_t i = 0; i < um.size(); ++i) {
    if (all.kept[i]) cells.add(all.c_deg[i], all.position_mm[i], um[i]);
  }
  return cells.to_json(3);
}

/// Measured against a true-running surface, and measured minus both simulations.
Json maps_data(const ProbeStream& stream, const SimulatedReadings& simulated,
               const ChartReadings& all) {
  const bool thinned = stream.size() > max_points;
  Json data = Json::object();
  if (!thinned || all.has_position) {
    const auto before = difference_um(stream.reading_mm, simulated.before_mm),
               after = difference_um(stream.reading_mm, simulated.after_mm);
    data = {{"measured_um", map_column(all, all.deviation_um, thinned)},
            {"before_um", map_column(all, before, thinned)},
            {"after_um", map_column(all, after, thinned)}};
  }
  if (!thinned) data["rejected"] = all.rejected();
  return data;
}

}  // namespace

Json simulation_data(const ProbeStream& stream, const Diagnosis& d, const Resimulation* again) {
  if (!complete(d, stream.size())) return nullptr;
  const std::vector<bool> masked = masked_readings(d);
  const bool by_lathe = again != nullptr && again->why_not.empty();
  const Resimulation shown = by_lathe ? *again : by_model(stream, d, masked);
  ChartReadings all = chart_readings(stream, d.baseline, CoaxialNominal(stream, d.baseline));
  // What the robust loss of the ideal fit excluded may be what was found: it counts.
  for (std::size_t i = 0; i < masked.size(); ++i) all.kept[i] = !masked[i];
  const Comparison& c = shown.comparison;
  return {{"by_lathe", by_lathe},
          {"why_not", again != nullptr ? again->why_not : ""},
          {"rms_before_mm", c.before.rms_mm},
          {"rms_after_mm", c.after.rms_mm},
          {"noise_mm", c.noise.rms_mm},
          {"left_share", c.after.share},
          {"noise_share", c.noise.share},
          {"spectrum", spectrum_data(c.spectrum)},
          {"maps", maps_data(stream, shown.readings, all)}};
}

}  // namespace trueaxis
