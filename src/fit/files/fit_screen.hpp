// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/fit.hpp"

namespace trueaxis {

/// A fit in some eight lines for a person: how good it is, the axis, the sizes, what to know of
/// it. Lines are not broken (the command does). fit_text() has every parameter.
std::string fit_screen(const FitResult& result);

/// "axis   x 48.19 µm, y -31.01 µm, U 0.35 µm at Z 0 mm" at both ends of the readings; of a plane
/// its tilt; empty where nothing was fitted.
std::string axis_screen(const FitResult& result);

}  // namespace trueaxis
