// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnose/diagnosis.hpp"

namespace trueaxis {

/// One row per reading: row, C[deg], position[mm], reading[mm], residual[um], rejected (0/1).
std::string residuals_csv(const ProbeStream& stream, const FitResult& result);

/// One row per reading: row, C[deg], Z[mm], X_M[mm], residual_before[um] of the ideal surface,
/// effect[um] of all findings, residual_after[um] of the extended model, masked (0/1). A number
/// that is not determined is an empty cell.
std::string residuals_csv(const ProbeStream& stream, const Diagnosis& diagnosis);

}  // namespace trueaxis
