// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "associate/extreme_element.hpp"

namespace trueaxis {

/// The least sum of squares among the elements outside of the material, all points on its side
/// (Eq. 254): what ISO 5459 takes for a datum that is not a Chebyshev one. Contacts carry the
/// multipliers of the mean square; `h` is the largest distance beyond, 0 but for rounding.
ExtremeElement constrained_element(const Placed& gaussian, const PointCloud& cloud,
                                   bool material_inside, int max_iterations);

}  // namespace trueaxis
