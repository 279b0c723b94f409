// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "correct/spectrum.hpp"

namespace trueaxis {

/// What would make a profile that breaks a limit follow: more rows a revolution where it is the
/// interpolation between them, faster set-points where it is the sampling, else the speed. Each was
/// tried, alone.
std::string remedy(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator,
                   double max_speed_rpm);

}  // namespace trueaxis
