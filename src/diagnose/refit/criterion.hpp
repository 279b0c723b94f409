// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regression/joint.hpp"

namespace trueaxis::diagnose_detail {

/// N ln RSS + k ln N (Schwarz 1978); what shapes a term, as the date of a slip, counts in k.
double criterion_of(const Joint& joint);

}  // namespace trueaxis::diagnose_detail
