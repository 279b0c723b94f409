// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "simulate/chain.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// A pass in time: constant speed and feed from an instant on.
struct TimedPass {
  double t_s = 0.0, c_rad = 0.0, position_mm = 0.0;  ///< at the first reading
  double omega_rad_per_s = 0.0, velocity_mm_per_s = 0.0;
  double interval_s = 0.0, jitter = 0.0;
  std::size_t count = 0;
  Chucking setup;

  Moment at(double time_s) const;
};

/// The set-up of a number as the plan has it; one that it does not tell is as the first.
Chucking find_setup(const Plan& plan, int number);

/// The plan's passes one after the other; C runs on. @throws InputError naming what is wrong.
std::vector<TimedPass> make_timeline(const Plan& plan);

}  // namespace trueaxis::virtual_lathe
