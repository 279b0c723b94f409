// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/sweep/summary.hpp"

namespace trueaxis {

/// Schema trueaxis.sweep/1: input hash, seed, options, cells and rows; no times.
std::string sweep_json(const study::Sweep& sweep, const study::Summary& summary);

}  // namespace trueaxis
