// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "blind_machine/judge.hpp"

namespace trueaxis::blind_machine {

/// What no catalogue has, of size 1: a local bump in an error of a rotary axis, steps in one of any
/// axis, an error that depends on two axes, the warming up of a machine.
/// @param which of the four
Effect drawn_unknown(const Machine& machine, const Plan& plan, int which, std::mt19937_64& engine);

}  // namespace trueaxis::blind_machine
