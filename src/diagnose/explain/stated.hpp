// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// The entry with what is stated of its one parameter. After the correction by the value, the rest
/// may be as far below 0 as the value is above the least that the parameter may be.
Effect as_stated(Effect effect, const Influence& influence);

/// Statements that a cause contradicts: the named cause is that of the statement, or its twin that
/// cancels what was stated, and what remains is beyond what is stated and found. @param entries
/// as_stated()
std::vector<RefutedStatement> refuted_statements(const std::vector<Finding>& findings,
                                                 std::span<const Effect> entries);

}  // namespace trueaxis::diagnose_detail
