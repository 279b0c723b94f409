// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "blind/study.hpp"

namespace trueaxis::blind {

/// Takes the recommended measurement (next_measurement; of an absorbed effect the one that its
/// entry in not_observable names) of a case with one true effect in the virtual lathe: the same
/// part, effects and seed with the pass or set-up appended. Resolved: the class that holds the
/// truth has fewer members than before, or the absorbed effect is found now. Nothing happens where
/// the truth was not in a class of several (nor absorbed), where nothing is recommended, and for a
/// measurement that is not of this part (MS).
void follow_advice(Result& result, const std::string& command, const std::filesystem::path& folder);

}  // namespace trueaxis::blind
