// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "job/files/job_results.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr const char* schema_line = "# schema: trueaxis.residuals/1\n";

/// A cell; "," where the value is not there.
void append(std::string& text, const std::vector<double>& values, std::size_t i, int decimals,
            double unit = 1.0) {
  const double value = i < values.size() ? values[i] : std::nan("");
  text += ',';
  if (std::isfinite(value))
    fmt::format_to(std::back_inserter(text), "{:.{}f}", value / unit, decimals);
}

void append_um(std::string& text, const std::vector<double>& values_mm, std::size_t i) {
  append(text, values_mm, i, 4, mm_per_um);
}

/// Row, C, position, reading.
void append_reading(std::string& text, const ProbeStream& stream, std::size_t i) {
  fmt::format_to(std::back_inserter(text), "{},{:.6f},{:.6f},{:.7f}", i + 1,
                 stream.c_rad[i] / rad_per_deg, stream.has_position() ? stream.position_mm[i] : 0.0,
                 stream.reading_mm[i]);
}

}  // namespace

std::string residuals_csv(const ProbeStream& stream, const FitResult& result) {
  expects(result.residual_mm.size() == stream.size(), "the fit of this stream");
  const bool face = stream.kind == StreamKind::face;
  std::string text = schema_line;
  text += face ? "row,C[deg],X[mm],Z_M[mm],residual[um],rejected\n"
               : "row,C[deg],Z[mm],X_M[mm],residual[um],rejected\n";
  const std::vector<bool> rejected = marked(result.rejected, stream.size());
  for (std::size_t i = 0; i < stream.size(); ++i) {
    append_reading(text, stream, i);
    fmt::format_to(std::back_inserter(text), ",{:.4f},{}\n", result.residual_mm[i] / mm_per_um,
                   rejected[i] ? 1 : 0);
  }
  return text;
}

std::string residuals_csv(const ProbeStream& stream, const Diagnosis& diagnosis,
                          const SimulatedReadings* simulated) {
  const std::vector<bool> masked = marked(diagnosis.noise.masked, stream.size());
  const std::vector<double>& before = diagnosis.residual_before_mm.empty()
                                          ? diagnosis.baseline.residual_mm
                                          : diagnosis.residual_before_mm;
  std::string text = schema_line;
  text += "row,C[deg],Z[mm],X_M[mm],residual_before[um],effect[um],residual_after[um],masked";
  text += simulated ? ",simulated_before[mm],simulated_after[mm]\n" : "\n";
  for (std::size_t i = 0; i < stream.size(); ++i) {
    append_reading(text, stream, i);
    append_um(text, before, i);
    append_um(text, diagnosis.effect_mm, i);
    append_um(text, diagnosis.residual_after_mm, i);
    text += masked[i] ? ",1" : ",0";
    if (simulated) {
      append(text, simulated->before_mm, i, 7);
      append(text, simulated->after_mm, i, 7);
    }
    text += '\n';
  }
  return text;
}

}  // namespace trueaxis
