// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "simulate/machine/control.hpp"

namespace trueaxis::virtual_machine {

/// Of every move of a program the index of the move of the nominal program to which it belongs.
/// Pieces of a block come before the move that ends it: this has the other words of the block, and
/// where more than one has these, it is the first after which the tool goes away from the block's
/// end again.
/// @throws InputError (of `file`) where the program has not all moves of the nominal one
std::vector<std::size_t> nominal_moves_of(const Machine& machine,
                                          std::span<const ControlMove> moves,
                                          std::span<const ControlMove> nominal,
                                          const std::string& file);

}  // namespace trueaxis::virtual_machine
