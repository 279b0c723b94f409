// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace trueaxis::form_study {

/// Radius of a part about its own axis.
using Radius = std::function<double(double angle_rad, double z_mm)>;

/// RONt of the worst section about the minimum zone and CYLt of a part after the weighting function
/// of ISO 16610-21, by sums over a fine grid; both by Newton steps on the range with soft ends.
struct TrueForm {
  double ront_mm = 0.0, cylt_mm = 0.0;
};
TrueForm true_form(const Radius& radius, double length_mm, double high_upr);

}  // namespace trueaxis::form_study
