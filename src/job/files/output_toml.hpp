// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/toml_reader.hpp"
#include "trueaxis/control_table.hpp"

namespace trueaxis {

/// One `[[output]]` of a job: a file for a control. What a control leaves open (radius or diameter,
/// what F means, numbers of axes) has no default.
/// @param templates is given the file that it is made by
ControlTable read_output(TomlTable table, std::vector<std::string>& templates);

}  // namespace trueaxis
