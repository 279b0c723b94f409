// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/fit/fit.hpp"

namespace trueaxis {

/// One row per reading: row, C[deg], position[mm], reading[mm], residual[um], rejected (0/1).
std::string residuals_csv(const ProbeStream& stream, const FitResult& result);

}  // namespace trueaxis
