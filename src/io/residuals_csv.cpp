// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/io/residuals_csv.hpp"

#include <cstdio>

#include "trueaxis/base/error.hpp"
#include "trueaxis/base/units.hpp"

namespace trueaxis {

std::string residuals_csv(const ProbeStream& stream, const FitResult& result) {
  expects(result.residual_mm.size() == stream.size(), "the fit of this stream");
  const bool face = stream.kind == StreamKind::face;
  std::string text = face ? "row,C[deg],X[mm],Z_M[mm],residual[um],rejected\n" : "row,C[deg],Z[mm],X_M[mm],residual[um],rejected\n";
  std::size_t next = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const bool rejected = next < result.rejected.size() && result.rejected[next].row == i + 1;
    if (rejected) ++next;
    char row[160];
    text.append(row, static_cast<std::size_t>(std::snprintf(
                         row, sizeof row, "%zu,%.6f,%.6f,%.7f,%.4f,%d\n", i + 1, stream.c_rad[i] / rad_per_deg,
                         stream.has_position() ? stream.position_mm[i] : 0.0, stream.reading_mm[i],
                         result.residual_mm[i] / mm_per_um, rejected ? 1 : 0)));
  }
  return text;
}

}  // namespace trueaxis
