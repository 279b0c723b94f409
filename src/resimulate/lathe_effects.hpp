// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// Where u = (position − z_mid)/z_half of a diagnosis comes from, and its clock.
struct LatheFrame {
  double z_mid_mm = 0.0, z_half_mm = 1.0;
  double time_start_s = 0.0, time_end_s = 0.0;
};

/// A fitted term as the virtual lathe has it: an effect by the catalogue's parameters, two or more
/// where the lathe has one phase or degree and the term several; a pattern as an effect extra.*.
/// @throws InputError for what the lathe cannot play: an effect that it has not, a term that is not
/// fitted, a form of the part that changes with time.
std::vector<virtual_lathe::Effect> lathe_effects(const TermValue& term, const LatheFrame& frame);

}  // namespace trueaxis
