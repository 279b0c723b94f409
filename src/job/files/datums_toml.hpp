// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "format/toml_reader.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// `association` of a reference; what its surface has not is complained about.
std::optional<Criterion> read_association(TomlTable reference, SurfaceKind surface, bool bore);

/// `datum` and `secondary_datum` of a target, names of references. Complains about what is none of
/// these and what makes no axis.
DatumSystem read_datums(TomlTable target, const Job& job);

}  // namespace trueaxis
