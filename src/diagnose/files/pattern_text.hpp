// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// "3 UPR", "7.41 UPR", "local form"
std::string harmonic_text(const Pattern& pattern);

/// "constant along Z", "P2 in time", "turning along Z, 0.14 per mm", "at 70.0° (± 12.5°)" …
std::string dependence_text(const Pattern& pattern);

}  // namespace trueaxis
