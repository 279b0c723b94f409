// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// Polar plots (schema trueaxis.spindle_plot/1): motion along the sensitive direction, with what
/// does not repeat, over C; beside it the form of the part.
std::string polar_svg(const SpindleResult& result);

}  // namespace trueaxis
