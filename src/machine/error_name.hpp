// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// An error in words: "along X, as C moves", "place of axis C along X", "zero of axis B".
std::string words_of(const ErrorName& name);

}  // namespace trueaxis
