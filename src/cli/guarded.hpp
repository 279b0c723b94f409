// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace trueaxis::cli {

/// What `run` returns, or the contract's exit code of what it throws, said on standard error.
int guarded(const std::function<int()>& run);

}  // namespace trueaxis::cli
