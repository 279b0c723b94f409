// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

// A slip near an end of a stream leaves too few readings beside it to be a finding, and where it is
// the last end the part stands elsewhere now.

/// That outliers gather at an end of a pass. Empty: they do not.
std::string left_out_at_an_end(const ProbeStream& stream, const Diagnosis& diagnosis);

/// That several of the last eight readings lie farther off than in any other eight, and than their
/// share elsewhere makes once in a thousand streams. Empty: they do not.
std::string far_off_at_the_end(const Diagnosis& diagnosis);

}  // namespace trueaxis
