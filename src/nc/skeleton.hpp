// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace trueaxis::nc {

/// Whether two programs differ in axis words, F, G93 and G94, and in lines of these only: one may
/// be the other, compensated. An empty program is like none.
bool differ_in_axis_words_only(std::string_view one, std::string_view other);

}  // namespace trueaxis::nc
