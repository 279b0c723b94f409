// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/form.hpp"

namespace trueaxis {

/// The radial error motion along the probe that a result of `trueaxis spindle` (JSON) states;
/// orders that it suppressed are not in it.
/// @throws InputError where the file is no such result, or its sensitive direction is not +X
std::vector<SpindleOrder> read_spindle_motion(const std::string& path);

}  // namespace trueaxis
