// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "format/toml_reader.hpp"
#include "trueaxis/control_table.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Tolerances of a reference's form and its filter; what the surface has not is complained about.
FormTask read_form_task(TomlTable reference, SurfaceKind surface);

/// Complains about a `runout_datum` that is not another reference which is probed around.
void check_runout_datums(TomlTable root, const Job& job);

/// `association` of a reference; what its surface has not is complained about.
std::optional<Criterion> read_association(TomlTable reference, SurfaceKind surface, bool bore);

/// `datum` and `secondary_datum` of a target, names of references. Complains about what does not
/// belong to these and what makes no axis.
DatumSystem read_datums(TomlTable target, const Job& job);

/// One `[[output]]` of a job: a file for a control. What a control leaves open (radius or diameter,
/// what F means, numbers of axes) has no default.
/// @param templates is given the file that it is made by
ControlTable read_output(TomlTable table, std::vector<std::string>& templates);

}  // namespace trueaxis
