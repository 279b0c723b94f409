// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "machine/files/machine_toml.hpp"

namespace trueaxis {

/// The errors of all files together, and those of a D-H machine's own parameters: entries of one
/// name add, and so do covariances, each file's being independent of the others'. `.toml` is
/// `trueaxis.errors/1`, `.csv` the ISG table, any other name the Etalon exchange format; the last
/// two do not say their sign, `foreign_sign` does.
/// @throws InputError with every diagnostic of every file; where component errors come from two.
ErrorModel read_errors(std::span<const std::string> paths, const MachineFile& machine,
                       std::optional<ErrorSign> foreign_sign = std::nullopt);

}  // namespace trueaxis
