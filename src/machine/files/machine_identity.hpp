// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/toml_reader.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// What errors of a machine are errors of, to a millionth: its chain, directions, lines of rotary
/// axes and the tool's gauge point and direction, a line of text each. Not in it is what changes
/// without the machine: work offsets, tool lengths, limits, the mode of its programs.
std::vector<std::string> kinematics_of(const Machine& machine);

/// The table [machine] of an errors file.
std::string machine_identity_toml(const Machine& machine);

/// Complains where a table [machine] is of another machine; without one nothing is fixed against
/// it.
void check_machine_identity(TomlTable& root, const Machine& machine);

/// The remark about a file of `errors` without that table (ISG and Etalon files have no place for
/// it). It is "" for one that has it, and for errors of a workpiece alone, which hold on any
/// machine.
std::string machine_not_said(const std::string& path, const ErrorModel& errors,
                             const Machine& machine);

}  // namespace trueaxis
