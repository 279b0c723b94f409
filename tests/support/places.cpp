// SPDX-License-Identifier: Apache-2.0
#include "support/places.hpp"

#include <cstdlib>

namespace places {

std::string command() {
  const char* other = std::getenv("TRUEAXIS_OTHER_COMMAND");  // of scripts/mutation_check
  return other ? other : TRUEAXIS_COMMAND;
}
std::string source() { return TRUEAXIS_SOURCE; }
std::string scratch() { return TRUEAXIS_SCRATCH; }
std::string measured_data() { return TRUEAXIS_MEASURED_DATA; }

}  // namespace places
