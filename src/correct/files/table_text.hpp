// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/correction.hpp"

namespace trueaxis {

/// The header of the correction table alone, every line with its `#`.
std::string correction_header(const Correction& correction);

/// Extremes, harmonics and the actuator's margin as text, µm and degrees.
std::string correction_preview(const Correction& correction);

}  // namespace trueaxis
