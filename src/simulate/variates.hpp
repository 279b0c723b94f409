// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "simulate/random.hpp"

namespace trueaxis::virtual_lathe {

/// Standard normal, by the ziggurat of 256 layers (Marsaglia and Tsang, 2000; layer and position
/// from different bits, Doornik, 2005). The same bits on every platform: tables and the rare cases
/// use exp and log of this file only.
double normal_variate(Xoshiro& bits);

/// Adds `sigma` times a normal variate each; bits and order are those of normal_variate.
void add_normal_variates(Xoshiro& bits, double sigma, std::span<double> to);

/// Student's t with `dof` > 2, scaled to standard deviation 1.
double student_variate(Xoshiro& bits, double dof);

}  // namespace trueaxis::virtual_lathe
