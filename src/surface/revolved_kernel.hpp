// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "surface/surface.hpp"

namespace trueaxis {

/// Columns of the revolved kernel; w = 1/(e·G) = 1/√disc, G = q − d (s + t r) half the gradient of
/// |q|² − s² − r², q from the axis point at z_ref, s along the axis, r = r(s).
enum RevolvedColumn { w_gx, w_gy, w_s_gx, w_s_gy, w_r, w_r_s, w_one, revolved_columns };

/// Prediction of one block: the root in X of the quadratic of Eq. 7 (height 0, no tilt), with
/// one division and one square root a reading. `offset_mm` is added to the prediction (a relative
/// gauge).
void evaluate_revolved(const Revolved& surface, Root root, double offset_mm,
                       const ReadingBlock& readings, PredictionBlock& out);

}  // namespace trueaxis
