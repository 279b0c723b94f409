// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "studies/published/placement.hpp"

namespace trueaxis {

/// Schema trueaxis.published/1: runs, readings of them and what print has lost, as numbers.
std::string published_json(const study::Sweep& sweep, const study::Published& published,
                           const study::Placement& placement);

}  // namespace trueaxis
