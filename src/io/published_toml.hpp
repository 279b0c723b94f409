// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "io/toml_reader.hpp"
#include "trueaxis/study/sweep.hpp"

namespace trueaxis {

/// A number of a `set` table as the scenario knows it; none after a diagnostic.
using ReadSetting = std::function<std::optional<study::Setting>(TomlTable&, const std::string&)>;

/// The table [paper] of a sweep whose axes and scenario are read.
study::Published read_published(TomlTable paper, const study::Sweep& sweep,
                                const ReadSetting& setting);

}  // namespace trueaxis
