// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "studies/published/placement.hpp"

namespace trueaxis {

/// For the terminal: each published run with the distribution of its cell, how well every reading
/// of the printed numbers fits, and intervals of what print has lost.
std::string published_text(const study::Sweep& sweep, const study::Published& published,
                           const study::Summary& summary, const study::Placement& placement);

}  // namespace trueaxis
