// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/fit.hpp"

namespace trueaxis {

/// The fit for a person at a terminal: status, parameters with U, what is left, what to do.
std::string fit_text(const FitResult& result);

}  // namespace trueaxis
