// SPDX-License-Identifier: Apache-2.0
#include "report/chart_readings.hpp"

#include <algorithm>
#include <cmath>

#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::vector<bool> kept_readings(const ProbeStream& stream, const FitResult& fit) {
  std::vector<bool> kept = marked(fit.rejected, stream.size());
  kept.flip();
  return kept;
}

double readings_per_turn(const ProbeStream& stream) {
  double travel_rad = 0.0;
  for (std::size_t i = 1; i < stream.size(); ++i) {
    travel_rad += std::abs(stream.c_rad[i] - stream.c_rad[i - 1]);
  }
  const double count = static_cast<double>(stream.size());
  return travel_rad > two_pi ? count * two_pi / travel_rad : count;
}

}  // namespace

double wrapped_deg(double c_rad) {
  const double turns = c_rad / two_pi;
  const double degrees = rounded(360.0 * (turns - std::floor(turns)), 3);
  return degrees >= 360.0 ? 0.0 : degrees;
}

Bins map_rows(const ChartReadings& all) {
  constexpr double most = 80.0;
  const double turns = static_cast<double>(all.kept.size()) / all.readings_per_turn;
  const double count = std::clamp(std::floor(turns), 1.0, most);
  return bins_over(all.position_mm, static_cast<std::size_t>(count));
}

ChartReadings chart_readings(const ProbeStream& stream, const FitResult& fit,
                             const CoaxialNominal& nominal) {
  ChartReadings all;
  all.has_model = nominal.from_fit();
  all.has_position = stream.has_position();
  all.time_s = stream.time_s;
  all.kept = kept_readings(stream, fit);
  all.readings_per_turn = readings_per_turn(stream);
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double position = position_of(stream, fit, i);
    all.c_deg.push_back(wrapped_deg(stream.c_rad[i]));
    all.position_mm.push_back(position);
    all.deviation_um.push_back((stream.reading_mm[i] - nominal.reading_mm(position)) / mm_per_um);
    if (all.has_model) all.residual_um.push_back(fit.residual_mm[i] / mm_per_um);
    if (all.has_model && !std::isfinite(fit.residual_mm[i])) all.kept[i] = false;
  }
  return all;
}

}  // namespace trueaxis
