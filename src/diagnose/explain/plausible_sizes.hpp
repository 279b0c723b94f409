// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A cause that is more than 20 times as large as the largest size of every cause in its class;
/// empty: there is none. A cause whose size is not a length counts as possible, and so does a slip.
std::string implausible_size(const Diagnosis& diagnosis);

}  // namespace trueaxis::diagnose_detail
