// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trueaxis::study {

/// A number of the scenario and what it is set to, in the unit inside (see ScenarioParameter).
struct Setting {
  std::string path;
  double value = 0.0;
};

}  // namespace trueaxis::study
