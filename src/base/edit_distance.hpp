// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace trueaxis {

/// Levenshtein's distance: letters to change, put in or take out; for "did you mean".
std::size_t edit_distance(std::string_view from, std::string_view to);

}  // namespace trueaxis
