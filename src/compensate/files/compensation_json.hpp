// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/compensation.hpp"

namespace trueaxis {

/// A file that the compensation read.
struct CompensationInput {
  std::string file, hash;
};

/// The result as JSON (schema trueaxis.compensation/1): lengths in mm, angles in degrees.
std::string compensation_json(const ProgramCompensation& result, const CompensationOptions& options,
                              const std::vector<CompensationInput>& inputs,
                              const std::vector<std::string>& remarks);

}  // namespace trueaxis
