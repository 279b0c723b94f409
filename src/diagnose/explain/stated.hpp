// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// The entry with what is stated of its one parameter: of readings that are corrected by the value,
/// what remains may be as much less as the value is above what the parameter may be at least.
Effect as_stated(Effect effect, const Influence& influence);

/// Statements that a finding contradicts: the named cause is that of the statement, or its twin
/// that takes back what was stated, and what remains is beyond what is stated and found.
/// @param entries as_stated()
std::vector<RefutedStatement> refuted_statements(const std::vector<Finding>& findings,
                                                 std::span<const Effect> entries);

}  // namespace trueaxis::diagnose_detail
