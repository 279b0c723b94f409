// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// "along X, as C moves" for EXC, "place of axis C along X" for X0C (ISO 230-1).
std::string in_words(const ErrorName& name);

}  // namespace trueaxis
