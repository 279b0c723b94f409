// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace trueaxis::cli {

/// The contract's exit codes.
enum Exit {
  done = 0,
  refused = 1,    ///< understood and not carried out, or a tolerance that is not met; Refusal
  usage = 2,      ///< of the command line
  input = 3,      ///< InputError
  numerical = 4,  ///< a fit that failed
  bug = 70        ///< ContractViolation, or any other exception
};

/// What `run` returns, or the contract's exit code of what it throws, said on standard error.
int guarded(const std::function<int()>& run);

}  // namespace trueaxis::cli
