// SPDX-License-Identifier: Apache-2.0
#include "support/places.hpp"

namespace places {

std::string command() { return TRUEAXIS_COMMAND; }
std::string source() { return TRUEAXIS_SOURCE; }
std::string scratch() { return TRUEAXIS_SCRATCH; }
std::string measured_data() { return TRUEAXIS_MEASURED_DATA; }

}  // namespace places
