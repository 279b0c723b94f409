// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace trueaxis {

/// sin and cos of a column of angles (rad), vectorised for the machine that runs it; spans of one
/// length. Error: at most 1 ulp of 1 for |angle| < 1e6 rad (Cody-Waite reduction in three parts,
/// the polynomials of Sun's fdlibm k_sin/k_cos on [-π/4, π/4]); beyond, that of the angle's own
/// last bit.
void sincos(std::span<const double> angle_rad, std::span<double> sine, std::span<double> cosine);

}  // namespace trueaxis
