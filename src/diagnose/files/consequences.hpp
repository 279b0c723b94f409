// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace trueaxis {

/// What a cause means for the user, or what to do about it, in a few words ("re-bore the soft
/// jaws"); empty for an effect that is not of the catalogue.
std::string_view consequence_of(std::string_view effect);

}  // namespace trueaxis
