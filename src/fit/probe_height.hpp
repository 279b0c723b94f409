// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Adds to the radius, the apex and the budget what a stated u of the probe's height does in the
/// second order: off by h a probe reads h²/2R less. Once.
void add_square_of_height(std::span<const Influence> influences, FitResult& fit);

/// The name of its line.
inline constexpr const char* square_of_height = "square of the probe height";

/// Whether the radius and its u hold for a probe on centre height: no height is stated, and none
/// was found.
bool holds_on_centre_height(const FitResult& fit);

}  // namespace trueaxis
