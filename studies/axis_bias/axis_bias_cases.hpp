// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studies/axis_bias/axis_bias.hpp"

namespace trueaxis::study {

/// Every effect of the catalogue that is a form, with lengths that fit the plan.
std::vector<AxisBiasCase> axis_bias_cases(const virtual_lathe::Scenario& scenario);

/// The plan of the catalogue's figures: cone of R = 40 mm, tan α = 0.1, e = 0.2 mm, tilt 1 mrad,
/// one helical pass over Z 0-60 mm at 60 rpm.
virtual_lathe::Scenario axis_bias_reference();

}  // namespace trueaxis::study
