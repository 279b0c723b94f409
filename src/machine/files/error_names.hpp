// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Why `text` names no error of this machine; empty: it names one.
std::string error_name_trouble(const std::string& text, const Machine& machine);

}  // namespace trueaxis
