// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// A line with the schema trueaxis.residuals/1, a header, and one row per reading: row, C[deg],
/// position[mm], reading[mm], residual[um], rejected (0/1).
std::string residuals_csv(const ProbeStream& stream, const FitResult& result);

/// One row per reading: row, C[deg], Z[mm], X_M[mm], residual_before[um] of the ideal surface,
/// effect[um] of all findings, residual_after[um] of the extended model, masked (0/1). A number
/// that is not determined is an empty cell. With `simulated` two columns more: what the virtual
/// lathe reads off the ideal surface and the extended model, simulated_before[mm] and
/// simulated_after[mm].
std::string residuals_csv(const ProbeStream& stream, const Diagnosis& diagnosis,
                          const SimulatedReadings* simulated = nullptr);

}  // namespace trueaxis
