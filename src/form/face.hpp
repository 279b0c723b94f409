// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "form/heights.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis::form {

/// Flatness, and axial run-out about the spindle axis, of a face stream (Z_M, C, X).
void assess_face(const ProbeStream& stream, std::span<const TakenOff> taken_off,
                 FormResult& result);

/// Flatness or straightness of heights, with U, as a group of the result.
void assess_heights(std::span<const std::array<double, 2>> at_mm, bool plane,
                    std::span<const double> height_mm, const AssessHeights& more,
                    std::span<const TakenOff> taken_off, FormResult& result);

}  // namespace trueaxis::form
