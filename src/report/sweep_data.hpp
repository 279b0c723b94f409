// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "study/sweep/summary.hpp"

namespace trueaxis {

/// Everything the page of a sweep shows (schema trueaxis.sweep_report/1): columns of edge units,
/// one entry a cell; a number that does not exist is NaN, which JSON writes as null.
nlohmann::json sweep_data(const study::Sweep& sweep, const study::Summary& summary);

/// The name of the sweep, or what it is.
std::string sweep_title(const study::Sweep& sweep);

/// Six digits: keeps the page small and its bytes free of the last bits.
double to_six_digits(double value);

}  // namespace trueaxis
