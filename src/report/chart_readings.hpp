// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "format/json.hpp"
#include "report/coaxial_nominal.hpp"
#include "report/thinning.hpp"

namespace trueaxis {

/// The readings of one reference in the units of the charts.
struct ChartReadings {
  bool has_model = false;            ///< a usable fit: residual_um is there
  bool has_position = false;         ///< false: one section without Z
  std::vector<double> c_deg;         ///< wrapped to [0, 360)
  std::vector<double> position_mm;   ///< Z, or X of a face
  std::vector<double> time_s;        ///< empty when the stream has no t
  std::vector<double> deviation_um;  ///< reading minus CoaxialNominal
  std::vector<double> residual_um;   ///< measured minus model
  std::vector<bool> kept;            ///< false: rejected by the fit, or not a number
  double readings_per_turn = 0.0;
};

ChartReadings chart_readings(const ProbeStream& stream, const FitResult& fit,
                             const CoaxialNominal& nominal);

/// Bins of the unrolled surface: of C, and of Z with no more rows than turns (rows between two
/// turns of a helix would stay blank).
inline constexpr Bins map_columns{0.0, 360.0, 120};
Bins map_rows(const ChartReadings& all);

/// C wrapped to [0, 360) degrees.
double wrapped_deg(double c_rad);

}  // namespace trueaxis
