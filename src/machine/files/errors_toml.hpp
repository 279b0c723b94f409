// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Reads `trueaxis.errors/1` (docs/machine.md) of a machine. Errors that are said to be of another
/// one are refused, and those of a size that machines have not unless the file or `large_errors`
/// says that they are so large.
/// @throws InputError with every diagnostic: file, line, column, what to do.
ErrorModel read_errors_toml(const std::string& path, const Machine& machine,
                            bool large_errors = false);
/// The same of what the file holds.
ErrorModel parse_errors_toml(std::string_view content, const std::string& path,
                             const Machine& machine, bool large_errors = false);

/// What `read_errors_toml` reads back. `of`: the machine that it will say the errors are of; errors
/// of a workpiece alone are of none.
std::string errors_toml(const ErrorModel& errors, const Machine* of = nullptr);

}  // namespace trueaxis
