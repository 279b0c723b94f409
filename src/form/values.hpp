// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trueaxis::form {

/// A value on its way to its uncertainty: what a trial of a Monte Carlo gives.
struct NamedValue {
  std::string group, name, reference;
  double value;
  std::string unit = "mm";
};

}  // namespace trueaxis::form
