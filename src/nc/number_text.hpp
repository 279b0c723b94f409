// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trueaxis::nc {

/// The number nearest to `value` that has `decimals` digits after the point; never -0.
double rounded(double value, int decimals);

/// Half a unit of the last of `decimals` digits after the point.
double half_of(int decimals);

/// Appends a number that was `rounded` to `decimals`, all of them written and no exponent.
void append_number(std::string& text, double value, int decimals);

}  // namespace trueaxis::nc
