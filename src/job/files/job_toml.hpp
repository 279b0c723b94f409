// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "job/files/job_file.hpp"

namespace trueaxis {

/// Reads a job (TOML, keys with their unit as suffix; docs/reference/job.md lists them).
/// @throws InputError with every diagnostic: unknown keys, wrong types, values out of range.
JobFile read_job_toml(const std::string& path);
/// The same of `content`; `path` names it and places relative file names.
JobFile read_job_toml(std::string_view content, const std::string& path);

/// Target, tool and actuator alone ("--target" of `correct`): the same keys as in a job; the other
/// tables of a job may be there and are not read.
Job read_target_toml(const std::string& path);

}  // namespace trueaxis
