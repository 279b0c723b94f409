// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/toml_reader.hpp"
#include "machine/files/machine_toml.hpp"

namespace trueaxis {

/// `chain` of either form; what is wrong with it is noted there.
void read_chain(TomlTable& root, Machine& machine);

/// `[[dh]]`, `part` and `tool` of a D-H file, whose chain is read already, made a zero-position
/// machine in the frame of the part: joint i turns about, or moves along, the z axis of frame i − 1
/// with all variables at 0 (Talyan et al., Tables 1 to 3).
void read_denavit_hartenberg(TomlTable& root, MachineFile& file);

}  // namespace trueaxis
