// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "nc/program.hpp"

namespace trueaxis::nc {

/// The text of a program with these lines (in order) under G93, each a block that turns rotary axes
/// alone: F is °/min there as long as no X Y Z moves, and mm/min once a correction moves them
/// (RS274/NGC 2.1.2.5). G93 has the time instead: its F is 1/t with t = √Σ Δ²/F. The next line has
/// G94 and the F of before again. No line is added. @throws InputError with all lines whose time is
/// not known
std::string with_timed_turns(const Program& program, std::span<const std::uint32_t> lines);

}  // namespace trueaxis::nc
