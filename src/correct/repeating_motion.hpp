// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/correction.hpp"

namespace trueaxis {

/// m at spindle angle C and height Z of a surface whose section has the slope dX/dZ, mm.
double motion_mm(const RepeatingMotion& motion, double c_rad, double z_mm, double dx_dz);

/// +1: a tool on the probe's side of the spindle, −1: on the other side, 0: elsewhere.
int side_of_tool(double angle_from_probe_rad);

}  // namespace trueaxis
