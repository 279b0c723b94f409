// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// Polar plots (schema trueaxis.spindle_plot/1): motion along the sensitive direction, with what
/// does not repeat, over C; beside it the form of the part.
std::string polar_svg(const SpindleResult& result);

/// The same one by one, each a drawing of its own, without schema.
std::vector<std::string> polar_svgs(const ErrorMotion& motion, bool axial, double coverage_factor);

}  // namespace trueaxis
