// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/doubts.hpp"

namespace trueaxis {

// A slip near an end of a stream leaves too few readings beside it to be a finding, and where it is
// the last end the part stands elsewhere now.

/// Outliers gather at an end of a pass.
extern const AxisDoubt left_out_at_an_end;

/// Several of the last eight readings lie farther off than in any other eight, and than their share
/// elsewhere makes once in a thousand streams.
extern const AxisDoubt far_off_at_the_end;

}  // namespace trueaxis
