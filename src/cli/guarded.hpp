// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "trueaxis/fit.hpp"

namespace trueaxis::cli {

/// The contract's exit codes.
enum Exit {
  done = 0,
  refused = 1,    ///< understood and not carried out, a tolerance not met, no axis known; Refusal
  usage = 2,      ///< of the command line
  input = 3,      ///< InputError
  numerical = 4,  ///< a fit that failed
  bug = 70        ///< ContractViolation, or any other exception
};

/// What `run` returns, or the contract's exit code of what it throws, said on standard error.
int guarded(const std::function<int()>& run);

/// What a script that takes the axis of `fit` has to know: numerical where it failed, refused where
/// its axis is not known, said on standard error.
int exit_code_of(const FitResult& fit, const std::string& source);

}  // namespace trueaxis::cli
