// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace trueaxis {

/// e to the power of every value of a column, vectorised for the machine that runs it; spans of one
/// length, which may be the same. Values to 709. Error: at most 1 ulp (Highway's Exp).
void exponential(std::span<const double> power, std::span<double> out);

}  // namespace trueaxis
