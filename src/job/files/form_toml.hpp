// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/toml_reader.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Tolerances of a reference's form and its filter; what the surface has not is complained about.
FormTask read_form_task(TomlTable reference, SurfaceKind surface);

/// Complains about a `runout_datum` that is no other reference which is probed around.
void check_runout_datums(TomlTable root, const Job& job);

}  // namespace trueaxis
