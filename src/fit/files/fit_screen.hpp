// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/fit.hpp"

namespace trueaxis {

/// A fit in some eight lines for a person: how good it is, the axis, the sizes, what to know of
/// it. Lines are not broken (the command does). fit_text() has every parameter.
std::string fit_screen(const FitResult& result);

/// "axis   x 48.19 µm, y -31.01 µm, U 0.35 µm at Z 0 mm" at both ends of the readings; of a plane
/// its tilt; empty where nothing was fitted. With tap_text().
std::string axis_screen(const FitResult& result);

/// For those without a servo: at which C the part stands out towards the probe, at the end that is
/// farther off, and how far to tap it there. The run-out is twice the distance of the axis; a probe
/// behind meets what stands out half a turn later. Empty where the offset is within twice its U, of
/// a plane, and where nothing was fitted.
std::string tap_text(const FitResult& result);

}  // namespace trueaxis
