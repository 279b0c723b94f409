// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "trueaxis/control_table.hpp"

namespace trueaxis {

// Each reads the text of a file as its control does and compares the result with the wanted
// correction, at the nodes of the file and between them.

Deviation grid_as_read(const Correction& correction, std::string_view text);
Deviation sinumerik_as_read(const Correction& correction, std::string_view text);
Deviation beckhoff_as_read(const Correction& correction, std::string_view text);
/// Straight between blocks, in C, X and Z; `blocks` is the text without what the shop has around
/// it.
Deviation servo_as_read(const Correction& correction, const ControlTable& table,
                        std::string_view blocks);
/// Each line held until the next, against straight lines between the commands: of them the
/// actuator's following error is known.
Deviation halstreamer_as_read(const Correction& correction, std::string_view text);

}  // namespace trueaxis
