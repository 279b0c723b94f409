// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/io/residuals_csv.hpp"

#include <cmath>
#include <cstdio>

#include "trueaxis/base/error.hpp"
#include "trueaxis/base/units.hpp"

namespace trueaxis {
namespace {

/// ",12.3456", or "," where the value is not there.
void append_um(std::string& text, const std::vector<double>& values_mm, std::size_t i) {
  const double value = i < values_mm.size() ? values_mm[i] : std::nan("");
  char cell[48] = ",";
  if (std::isfinite(value)) std::snprintf(cell, sizeof cell, ",%.4f", value / mm_per_um);
  text += cell;
}

}  // namespace

std::string residuals_csv(const ProbeStream& stream, const FitResult& result) {
  expects(result.residual_mm.size() == stream.size(), "the fit of this stream");
  const bool face = stream.kind == StreamKind::face;
  std::string text = face ? "row,C[deg],X[mm],Z_M[mm],residual[um],rejected\n"
                          : "row,C[deg],Z[mm],X_M[mm],residual[um],rejected\n";
  std::size_t next = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const bool rejected = next < result.rejected.size() && result.rejected[next].row == i + 1;
    if (rejected) ++next;
    char row[160];
    text.append(
        row, static_cast<std::size_t>(std::snprintf(
                 row, sizeof row, "%zu,%.6f,%.6f,%.7f,%.4f,%d\n", i + 1,
                 stream.c_rad[i] / rad_per_deg, stream.has_position() ? stream.position_mm[i] : 0.0,
                 stream.reading_mm[i], result.residual_mm[i] / mm_per_um, rejected ? 1 : 0)));
  }
  return text;
}

std::string residuals_csv(const ProbeStream& stream, const Diagnosis& diagnosis) {
  std::vector<bool> masked(stream.size(), false);
  for (const Rejected& r : diagnosis.noise.masked) {
    if (r.row >= 1 && r.row <= masked.size()) masked[r.row - 1] = true;
  }
  const std::vector<double>& before = diagnosis.residual_before_mm.empty()
                                          ? diagnosis.baseline.residual_mm
                                          : diagnosis.residual_before_mm;
  std::string text =
      "row,C[deg],Z[mm],X_M[mm],residual_before[um],effect[um],residual_after[um],masked\n";
  for (std::size_t i = 0; i < stream.size(); ++i) {
    char row[120];
    text.append(row,
                static_cast<std::size_t>(std::snprintf(
                    row, sizeof row, "%zu,%.6f,%.6f,%.7f", i + 1, stream.c_rad[i] / rad_per_deg,
                    stream.has_position() ? stream.position_mm[i] : 0.0, stream.reading_mm[i])));
    append_um(text, before, i);
    append_um(text, diagnosis.effect_mm, i);
    append_um(text, diagnosis.residual_after_mm, i);
    text += masked[i] ? ",1\n" : ",0\n";
  }
  return text;
}

}  // namespace trueaxis
