// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// An error motion of the machine that the probe saw along X and that repeats while cutting. The
/// part (or the slide) is off by m(C, Z) towards the probe; a tool on the same side follows it by
/// +m, or it would leave −m in the part; one on the other side by −m. In between it is unknown: the
/// probe saw one direction only.
struct RepeatingMotion {
  TermValue term;                          ///< of an effect of the catalogue, fitted
  double z_mid_mm = 0.0, z_half_mm = 1.0;  ///< u = (z − z_mid)/z_half
};

/// m at spindle angle C and height Z of a surface whose section has the slope dX/dZ, mm.
double motion_mm(const RepeatingMotion& motion, double c_rad, double z_mm, double dx_dz);

/// +1: a tool on the probe's side of the spindle, −1: on the other side, 0: elsewhere.
int side_of_tool(double angle_from_probe_rad);

}  // namespace trueaxis
