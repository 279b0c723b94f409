// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace trueaxis {

/// A place in mm for messages: to a hundredth, never −0.
inline double hundredths(double mm) { return std::round(100.0 * mm) / 100.0 + 0.0; }

}  // namespace trueaxis
