// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A finding that is more than 20 times as large as the largest size of every cause in its class;
/// empty: there is none. A cause whose size is no length is taken to be possible, and so is a slip.
std::string implausible_size(const Diagnosis& diagnosis);

}  // namespace trueaxis::diagnose_detail
