// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trueaxis::cli {

/// A program cannot say that TrueAxis wrote it, for all its bytes are the user's: what may be
/// `program`, compensated before, is replaced. @throws InputError where another program stands
void expect_no_other_program(const std::string& path, const std::string& program, bool force);

}  // namespace trueaxis::cli
