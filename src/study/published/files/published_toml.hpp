// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "format/toml_reader.hpp"
#include "study/sweep/sweep.hpp"

namespace trueaxis {

/// The numbers of a `set` table as the scenario knows them.
using ReadSet = std::function<std::vector<study::Setting>(const TomlTable&)>;

/// The table [paper] of a sweep whose axes and scenario are read.
study::Published read_published(TomlTable paper, const study::Sweep& sweep,
                                const ReadSet& read_set);

}  // namespace trueaxis
