// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {
/// "3 UPR", "7.41 UPR", "local form"
std::string harmonic_text(const Pattern& pattern);

/// "constant along Z", "P2 in time", "turning along Z, 0.14 per mm", "at 70.0° (± 12.5°)" …
std::string dependence_text(const Pattern& pattern);

/// "order 3, amplitude 4.2 ± 0.3 µm, phase 12.4 ± 1.2 deg"
std::string finding_parameters(const Finding& finding, double coverage_factor);

/// "part.roundness or spindle.radial_synchronous (0.50, 0.50): the data cannot tell"
std::string finding_class(const Finding& finding);

/// "moves the axis by 1.2 ± 0.3 µm", and whether it is cosmetic
std::string finding_axis_bias(const Finding& finding, double coverage_factor, bool face = false);

/// "RC, re-index by 70 deg: power 0.50 → 0.99, 12 min"
std::string separating_text(const Separating& separating);

/// axis bias per unit in µm
std::string axis_bias_per_unit_text(const Estimate& axis_bias);

}  // namespace trueaxis
