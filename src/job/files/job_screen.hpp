// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// A job in some ten lines for a person: the verdict, its reasons, what each reference shows, what
/// the tool does, what to do next. Lines are not broken (the command does). job_text() has the
/// rest.
std::string job_screen(const JobResult& result);

}  // namespace trueaxis
